/// An orbit of pictures in one page.
#pragma once
#include "app/library/picture/make_picture.h"
#include "app/library/picture/series/make.h"

namespace splatray {

/// Makes the pictures of --orbit and writes the page (app/library/codec/orbit_page.h). Throws Error as make() does.
[[nodiscard]] SequenceRecord make_orbit(const Shot& shot, SceneOnDevice& shown,
                                        const SequenceListener& listener);

}  // namespace splatray
