#pragma once

#include <exception>
#include <string>

namespace gonio::test {

/// The text of the exception that `call` throws; "no error" if it returns.
template <class Call>
std::string message_of(Call&& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace gonio::test
