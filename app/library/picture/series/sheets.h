/// Several drawings of one file: views on a page, the floors of an atlas.
#pragma once
#include "app/library/picture/series/make.h"

namespace splatray {

/// Makes the sheets of a shot's set one after the other, and writes their file: all of them, or none. Throws as make() does.
[[nodiscard]] SequenceRecord make_sheets(const Shot& shot, SceneOnDevice& shown,
                                         const SequenceListener& listener);

}  // namespace splatray
