/// The library that is loaded when a URL is opened: all of libcurl that this project uses.
#pragma once
#include <memory>
#include <string>

#include "preprocess/read/bytes/byte_source.h"

/// Opens what a URL of http or https names by ranges of bytes (RFC 9110, section 14). Redirects are followed, never from https to http.
/// Certificates are checked against the system's authorities, or those in the file that CURL_CA_BUNDLE names. Reads fail where the
/// server stops to answer, three tries later, and where what it has is no longer what was opened, by its size, ETag or time. Throws Error
/// (input_unreadable), one sentence.
extern "C" void splatray_open_remote(const std::string& url, std::unique_ptr<splatray::ByteSource>& source);
