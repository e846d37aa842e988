// `effects compile` on a terminal: how far it is, out of the way of results.
#include "CliTools.h"

namespace crevice::cli {
namespace {

class EffectsProgressCli : public CliTest {};

TEST_F(EffectsProgressCli, ATerminalIsToldHowFarItIs) {
    const std::vector<std::string> arguments{"effects", "compile", "copy", "vignette"};
    const Outcome terminal = runWith(arguments, Stream::Read, Stream::Terminal);
    EXPECT_EQ(terminal.code, 0) << terminal.err;
    EXPECT_NE(terminal.err.find("1 of 2: copy, 0 done"), std::string::npos) << terminal.err;
    EXPECT_NE(terminal.err.find("2 of 2: vignette, 1 done"), std::string::npos) << terminal.err;
    EXPECT_TRUE(terminal.err.ends_with("\r\033[K")) << "the line is taken away at the end";
    // Each line is taken away before a result is printed, which may go to the same terminal.
    const std::string shown = "1 of 2: copy, 0 done";
    EXPECT_EQ(terminal.err.substr(terminal.err.find(shown) + shown.size(), 4), "\r\033[K");

    const Outcome file = runWith(arguments, Stream::Read, Stream::Read);
    EXPECT_EQ(file.code, 0) << file.err;
    EXPECT_EQ(file.err, "");
    EXPECT_EQ(file.out, terminal.out);

    const Outcome quiet = runWith({"effects", "compile", "copy", "-q"}, Stream::Read, Stream::Terminal);
    EXPECT_EQ(quiet.err, "");
}

}  // namespace
}  // namespace crevice::cli
