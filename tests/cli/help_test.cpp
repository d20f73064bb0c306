/// What programs say of themselves: -h, --help, the completion of shells, and what they take a wrong name for.
#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

#include "app/cli/completion.h"
#include "app/library/request/fields.h"
#include "engine/base/nearest_name.h"
#include "tests/cli/child_process.h"

namespace splatray {
namespace {

using Lines = std::vector<std::string>;

Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::set<std::string> matches(const std::string& text, const std::string& pattern) {
  std::set<std::string> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match)
    found.insert((*match)[1]);
  return found;
}

/// What a program that the project has says.
class CliHelp : public CliTest, public testing::WithParamInterface<std::string> {
 protected:
  [[nodiscard]] static ChildResult say(const Lines& words, const std::string& columns = "80") {
    Lines command{GetParam()};
    command.insert(command.end(), words.begin(), words.end());
    return run_program(command, {"COLUMNS=" + columns});
  }
  /// The long options that --help lists.
  [[nodiscard]] static std::set<std::string> options() {
    return matches(say({"--help"}, "1000").out, "\n  (?:-\\w,)?(--[a-z-]+)[ \n]");
  }
};

TEST_P(CliHelp, ShortIsAScreen) {
  const ChildResult result = say({"-h"});
  EXPECT_EQ(result.code, 0) << result.err;
  const Lines lines = lines_of(result.out);
  EXPECT_LE(lines.size(), 30U) << result.out;
  EXPECT_GE(lines.size(), 10U) << result.out;
  for (const std::string& line : lines) EXPECT_LE(line.size(), 80U) << line;
  for (const char* words : {"Usage: splatray-", "Examples:\n  splatray-", "--help"})
    EXPECT_NE(result.out.find(words), std::string::npos) << words << result.out;
}

TEST_P(CliHelp, LongFitsTheWidthAndSaysTheSame) {
  std::set<std::string> texts;
  for (const std::size_t width : {40U, 60U, 80U, 100U, 400U}) {
    const ChildResult result = say({"--help"}, std::to_string(width));
    EXPECT_EQ(result.code, 0) << result.err;
    for (const std::string& line : lines_of(result.out)) EXPECT_LE(line.size(), width) << line;
    std::string letters = result.out;
    std::erase_if(letters, [](char c) { return c == ' ' || c == '\n' || c == '\\'; });
    texts.insert(letters);
    const std::string examples = result.out.substr(result.out.find("\nExamples:\n"));
    EXPECT_EQ(matches(examples, "\n  (splatray)").size(), 1U) << result.out;
    EXPECT_EQ(std::count(examples.begin(), examples.end(), '\n') >= 6, true) << result.out;
  }
  EXPECT_EQ(texts.size(), 1U) << "words are lost or added where lines are broken";
}

TEST_P(CliHelp, EachOptionThatTheShortHelpShowsIsOne) {
  const std::set<std::string> all = options();
  EXPECT_TRUE(all.contains("--help") && all.contains("--version"));
  for (const std::string& option : matches(say({"-h"}).out, "\n  (?:-\\w,)?(--[a-z-]+)[ \n]"))
    EXPECT_TRUE(all.contains(option)) << option;
}

TEST_P(CliHelp, CompletionHasExactlyItsOptions) {
  const std::set<std::string> all = options();
  EXPECT_EQ(matches(say({"--completion", "zsh"}).out, "'\\*?(--[a-z-]+)[=\\[]"), all);
  std::set<std::string> fish;
  for (const std::string& name : matches(say({"--completion", "fish"}).out, " -l ([a-z-]+) "))
    fish.insert("--" + name);
  EXPECT_EQ(fish, all);
  const std::string bash = write("complete.bash", say({"--completion", "bash"}).out);
  const std::string name = std::filesystem::path(GetParam()).filename();
  std::string function = "_" + name;
  std::replace(function.begin(), function.end(), '-', '_');
  const ChildResult offered =
      run_program({"/bin/bash", "-euc",
                   "source '" + bash + "'; complete -p " + name + " >&2; COMP_WORDS=(" + name +
                       " --); COMP_CWORD=1; " + function + "; printf ' %s \\n' \"${COMPREPLY[@]}\""});
  EXPECT_EQ(offered.code, 0) << offered.err;
  EXPECT_NE(offered.err.find("-F " + function + " " + name), std::string::npos) << offered.err;
  EXPECT_EQ(matches(offered.out, " (--[a-z-]+) "), all);
  EXPECT_EQ(say({"--completion", "ksh"}).code, 2);
}

TEST_P(CliHelp, AnOptionThatIsNoneGetsTheNearest) {
  expect_refused([&] { return say({"--versoin"}); }, 2, "unknown option --versoin; did you mean --version?");
  expect_refused([&] { return say({"--qqqqqqqqqqqq=1"}); }, 2, "unknown option --qqqqqqqqqqqq (--help lists");
}

INSTANTIATE_TEST_SUITE_P(Of, CliHelp,
                         ::testing::Values(PREPROCESS, RENDER, INFO, MEASURE, MERGE, VIEW, GENERATE),
                         [](const auto& test) {
                           const std::string name = std::filesystem::path(test.param).filename();
                           return name.substr(name.find('-') + 1);
                         });

class CliNames : public CliTest {};

TEST_F(CliNames, WrongNamesGetTheNearest) {
  const std::string grid = write("grid.ply", grid_ply(true));
  const auto refused = [&](std::vector<std::string> words, const std::string& sentence) {
    words.insert(words.begin(), grid);
    expect_refused([&] { return render(words); }, 2, sentence);
  };
  refused({"--colour-by=rgb"}, "unknown option --colour-by; did you mean --color-by?");
  refused({"--colour", "rgb"}, "did you mean --color-by?");
  refused({"--resolutoin", "4x4"}, "did you mean --resolution?");
  refused({"--look", "papper"}, "expected one of auto|lit|clay|ao|scan|paper; did you mean paper?");
  refused({"--tone=AGX"}, "did you mean agx?");
  refused({"--sheet=plna"}, "did you mean plan?");
  refused({"--aov=dpeth", "-o", file("a.exr")}, "did you mean depth?");
  refused({"--object=0:rougness=1"}, "did you mean roughness?");
  refused({"--color-by=hieght"}, "did you mean height?");
  const std::string request = write("r.json", R"({"inputs": ["a.ply"], "colour-by": "rgb"})");
  expect_refused([&] { return render({"--request", request}); }, 3, "did you mean color-by?");
}

TEST_F(CliNames, BashCompletesValuesAndFiles) {
  const std::string script = write("complete.bash", run_program({RENDER, "--completion", "bash"}).out);
  for (const char* name : {"a scan.LAZ", "b.txt", "c.jpg", "d.soct"}) write(name, "");
  std::filesystem::create_directory(folder / "e");
  const auto offered = [&](const std::string& words) {
    const ChildResult result = run_program({"/bin/bash", "-euc",
                                            "cd '" + folder.string() + "'; source '" + script +
                                                "'; COMP_WORDS=(splatray-render " + words +
                                                "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _splatray_render; "
                                                "printf '%s\\n' ${COMPREPLY[@]+\"${COMPREPLY[@]}\"}"});
    EXPECT_EQ(result.code, 0) << result.err;
    Lines lines = lines_of(result.out);
    std::sort(lines.begin(), lines.end());
    return lines;
  };
  EXPECT_EQ(offered("--look p"), (Lines{"paper"}));
  EXPECT_EQ(offered("--look = p"), (Lines{"paper"})) << "as bash breaks --look=p";
  EXPECT_EQ(offered("--view ="), (Lines{"auto", "dollhouse", "front", "inside", "oblique", "sensor", "top"}));
  EXPECT_EQ(offered("''"), (Lines{"a scan.LAZ", "b.txt", "d.soct", "e"})) << "no pictures";
  EXPECT_EQ(offered("--from c"), (Lines{"c.jpg", "complete.bash"}));
  EXPECT_EQ(offered("--data-path ''"), (Lines{"e"}));
  EXPECT_EQ(offered("--samples ''"), (Lines{""})) << "nothing is known of numbers";
}

TEST(NearestName, IsTheOneMeant) {
  const Lines names = names_of(DOOR_RENDER);
  for (const auto& [word, meant] :
       {std::pair("colour-by", "color-by"), std::pair("Samples", "samples"), std::pair("smaples", "samples"),
        std::pair("res", "resolution"), std::pair("lihgt", "light"), std::pair("environement", "environment"),
        std::pair("output-file", ""), std::pair("zz", "")})
    EXPECT_EQ(nearest_name(word, names), meant) << word;
  EXPECT_EQ(nearest_name("grey", {"gray", "great"}), "gray");
  EXPECT_EQ(nearest_name("size", {"side", "resolution"}), "resolution") << "as other programs call it";
  EXPECT_EQ(nearest_name("size", {"side"}), "side") << "a program without a resolution";
  EXPECT_EQ(nearest_name("", {"a"}), "");
  EXPECT_EQ(did_you_mean("plna", {"plan"}, "--"), "; did you mean --plan?");
}

}  // namespace
}  // namespace splatray
