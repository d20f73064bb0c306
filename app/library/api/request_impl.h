/// What a Request of the interface holds.
#pragma once
#include "app/library/request/request.h"
#include "app/library/splatray.h"

namespace splatray::api {

struct Request::Impl {
  splatray::Request request;
};

struct RequestAccess {
  [[nodiscard]] static const splatray::Request& inner(const Request& request);
};

}  // namespace splatray::api
