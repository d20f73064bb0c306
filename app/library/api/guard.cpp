#include "app/library/api/guard.h"

#include <stdexcept>

#include "engine/base/one_line.h"

namespace splatray::api {
namespace {

ErrorKind kind_of(ExitCode code) {
  switch (code) {
    case ExitCode::usage:
      return ErrorKind::usage;
    case ExitCode::input_unreadable:
      return ErrorKind::input;
    case ExitCode::no_device:
      return ErrorKind::no_device;
    case ExitCode::out_of_memory:
      return ErrorKind::out_of_memory;
    case ExitCode::interrupted:
      return ErrorKind::cancelled;
    default:
      return ErrorKind::failed;
  }
}

}  // namespace

Error::Error(ErrorKind kind, const std::string& sentence) : std::runtime_error(sentence), kind_(kind) {}
Error::~Error() = default;
ErrorKind Error::kind() const { return kind_; }

void rethrow_as_error() {
  try {
    throw;
  } catch (const Error&) {
    throw;
  } catch (const splatray::Error& error) {
    throw Error(kind_of(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::out_of_memory, "out of memory");
  } catch (const std::length_error&) {
    throw Error(ErrorKind::out_of_memory, "out of memory");
  } catch (const std::exception& error) {
    throw Error(ErrorKind::failed, one_line(error.what()));
  }
}

void refuse(const std::string& found, const std::string& expected) {
  throw Error(ErrorKind::usage, "found " + found + ", expected " + expected);
}

}  // namespace splatray::api
