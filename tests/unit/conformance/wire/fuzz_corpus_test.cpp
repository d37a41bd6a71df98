// The fuzzers of tests/fuzz begin with the wire cases of standards/modbus, one file for each.
//
// After a change of the cases: rm -r tests/fuzz/corpus, then run this test with
// GONIO_WRITE_CORPUS=1.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "emulator/protocol/rtu_framer.hpp"
#include "emulator/protocol/tcp_framer.hpp"
#include "tests/conformance/wire_cases.hpp"

namespace gonio::test {
namespace {

using conformance::ProbeStep;
using conformance::WireCase;

const std::filesystem::path source = GONIO_SOURCE_DIR;

/// File contents by path within the corpus.
using Corpus = std::map<std::string, Bytes>;

/// Each content once: many cases differ in their replies only.
void add(Corpus& corpus, const std::string& folder, const std::string& id, const Bytes& bytes) {
  std::string name = folder + "/" + id;
  for (int i = 2; corpus.contains(name); ++i) {
    name = fmt::format("{}/{}_{}", folder, id, i);
  }
  const bool is_new = std::none_of(corpus.begin(), corpus.end(), [&](const auto& file) {
    return file.first.starts_with(folder + "/") && file.second == bytes;
  });
  if (is_new) {
    corpus[name] = bytes;
  }
}

/// Chunks as rtu_framer_fuzzer.cpp reads them.
Bytes as_chunks(std::span<const std::uint8_t> burst) {
  constexpr std::size_t largest = 63;
  Bytes chunks;
  for (bool is_first = true; !burst.empty(); is_first = false) {
    const std::size_t size = std::min(largest, burst.size());
    chunks.push_back(static_cast<std::uint8_t>(size | (is_first ? 0x80U : 0U)));
    chunks.insert(chunks.end(), burst.begin(), burst.begin() + std::ptrdiff_t(size));
    burst = burst.subspan(size);
  }
  return chunks;
}

void add_tcp(const WireCase& sent, Corpus& corpus) {
  Bytes stream;
  for (const ProbeStep& step : sent.exchange.steps) {
    stream.insert(stream.end(), step.sent.begin(), step.sent.end());
  }
  if (!sent.exchange.is_for_serial) {
    add(corpus, "tcp_framer", sent.id, stream);
  }
  modbus::TcpFramer framer;
  std::copy(stream.begin(), stream.end(), framer.space().begin());
  framer.received(stream.size());
  while (const auto frame = framer.next()) {
    add(corpus, "pdu", sent.id, Bytes(frame->pdu.begin(), frame->pdu.end()));
  }
}

void add_serial(const WireCase& sent, Corpus& corpus) {
  Bytes chunks;
  for (const ProbeStep& step : sent.exchange.steps) {
    const Bytes more = as_chunks(step.sent);
    chunks.insert(chunks.end(), more.begin(), more.end());
    modbus::RtuFramer framer{std::chrono::microseconds(1)};
    framer.feed(step.sent, {});
    const auto frame = framer.end_of_frame(modbus::RtuFramer::Time(std::chrono::seconds(1)));
    if (frame) {
      add(corpus, "pdu", sent.id, Bytes(frame->pdu.begin(), frame->pdu.end()));
    }
  }
  if (!sent.exchange.is_for_tcp) {
    add(corpus, "rtu_framer", sent.id, chunks);
  }
}

/// The framers take the cases of their own line, the PDU function those of both.
Corpus corpus_of_cases() {
  const conformance::Profile profile = conformance::shipped_profile(source, "plain");
  Corpus corpus;
  for (const WireCase& sent : conformance::wire_cases(source, modbus::Line::tcp, profile)) {
    add_tcp(sent, corpus);
  }
  for (const WireCase& sent : conformance::wire_cases(source, modbus::Line::serial, profile)) {
    add_serial(sent, corpus);
  }
  return corpus;
}

Bytes read_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(FuzzCorpus, HoldsEveryWireCase) {
  const std::filesystem::path folder = source / "tests/fuzz/corpus";
  const bool writes = std::getenv("GONIO_WRITE_CORPUS") != nullptr;
  for (const auto& [name, bytes] : corpus_of_cases()) {
    if (writes) {
      std::filesystem::create_directories((folder / name).parent_path());
      std::ofstream(folder / name, std::ios::binary)
          .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    }
    EXPECT_EQ(hex(read_bytes(folder / name)), hex(bytes)) << name;
  }
}

}  // namespace
}  // namespace gonio::test
