#include "app/view/model/attempt.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <new>

#include "app/view/model/document.h"
#include "engine/base/error.h"

namespace splatray {
namespace {

TEST(Attempt, WhateverGoesWrongIsASentence) {
  EXPECT_FALSE(attempt("working", [] {}));
  const auto sentence = [](const std::function<void()>& step) {
    return attempt("opening a.ply", step).value().sentence;
  };
  EXPECT_EQ(sentence([] { throw Error(ExitCode::failed, "a.ply: found b, expected c"); }),
            "a.ply: found b, expected c");
  EXPECT_EQ(sentence([] { throw std::bad_alloc(); }), "out of memory while opening a.ply");
  const std::string missing = sentence([] { (void)std::filesystem::file_size("/missing/a.ply"); });
  EXPECT_NE(missing.find("opening a.ply"), std::string::npos) << missing;
}

TEST(Attempt, InterruptedIsNoMistake) {
  EXPECT_TRUE(attempt("", [] { throw Error(ExitCode::interrupted, "stopped"); }).value().interrupted);
  EXPECT_FALSE(attempt("", [] { throw Error(ExitCode::failed, "failed"); }).value().interrupted);
}

TEST(DocumentCopies, ShareWhatStaysAsLoaded) {
  const Document document, copy = document;
  EXPECT_EQ(copy.loaded, document.loaded);
}

}  // namespace
}  // namespace splatray
