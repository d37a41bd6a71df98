#include "reports/pdf.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>

#include "emulator/core/text_file.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/reports/fake_gnuplot.hpp"

// That a real Chromium prints a certificate is seen in tests/pages.

namespace gonio {
namespace {

using test::FakeProgram;
using testing::HasSubstr;

/// Finds the file that is asked for in the arguments: $pdf.
const std::string find_pdf =
    "for a in \"$@\"; do case \"$a\" in --print-to-pdf=*) pdf=\"${a#*=}\";; esac; done; ";

TEST(PrintedPdf, KeepsWhatTheBrowserPrints) {
  const FakeProgram browser("chromium", find_pdf + "printf '%%PDF-1.4 of a page' > \"$pdf\"");
  EXPECT_EQ(printed_pdf("<html></html>"), "%PDF-1.4 of a page");
}

TEST(PrintedPdf, TakesAnotherNameOfTheBrowser) {
  const FakeProgram browser("google-chrome", find_pdf + "printf '%%PDF' > \"$pdf\"");
  const test::SearchPath path(browser.folder().string());  // no chromium there
  EXPECT_EQ(printed_pdf("<html></html>"), "%PDF");
}

TEST(PrintedPdf, GivesTheBrowserThePageAndAProfileThatGoWithIt) {
  const FakeProgram browser("chromium", find_pdf +
                                            "for a in \"$@\"; do echo \"$a\" >> $here/said; done; "
                                            "cp \"$(dirname \"$pdf\")/page.html\" $here/page; "
                                            "printf '%%PDF' > \"$pdf\"");
  (void)printed_pdf("<p>the page</p>");
  EXPECT_EQ(read_text_file(browser.folder() / "page"), "<p>the page</p>");
  const std::string said = read_text_file(browser.folder() / "said");
  EXPECT_THAT(said, HasSubstr("--headless\n"));
  const auto begin = said.find("--user-data-dir=") + std::string("--user-data-dir=").size();
  const std::filesystem::path profile = said.substr(begin, said.find('\n', begin) - begin);
  EXPECT_TRUE(profile.is_absolute());
  EXPECT_FALSE(std::filesystem::exists(profile.parent_path()));
}

TEST(PrintedPdf, WithoutABrowserIsAnErrorOfTheEnvironmentThatNamesThem) {
  const test::TemporaryFolder folder;
  const test::SearchPath path(folder.path().string());
  try {
    (void)printed_pdf("");
    FAIL() << "no exception";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code().value(), ENOENT);
    EXPECT_THAT(error.what(),
                HasSubstr("none of chromium, chromium-browser, google-chrome is installed"));
  }
}

std::string complaint_of(const std::string& commands) {
  const FakeProgram browser("chromium", commands);
  return test::message_of([] { (void)printed_pdf("<html></html>"); });
}

TEST(PrintedPdf, TellsWhatTheBrowserComplainsOf) {
  EXPECT_THAT(complaint_of("echo no paper >&2; exit 3"),
              HasSubstr("chromium ended with status 3: no paper"));
  EXPECT_THAT(complaint_of("kill -9 $$"), HasSubstr("ended by signal 9"));
  EXPECT_THAT(complaint_of("true"), HasSubstr("chromium made no PDF of the page"));
  EXPECT_THAT(complaint_of(find_pdf + "echo '<html>' > \"$pdf\""), HasSubstr("made no PDF"));
}

}  // namespace
}  // namespace gonio
