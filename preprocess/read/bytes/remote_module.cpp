#include "preprocess/read/bytes/remote_module.h"

#include <curl/curl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <future>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/one_line.h"
#include "preprocess/base/lower_case.h"

namespace splatray {
namespace {

constexpr long HAS_PART = 206, BEHIND_END = 416;

/// What an answer says of itself.
struct Answer {
  long status = 0;
  std::uint64_t size = 0;  ///< of the whole, 0 = not said
  std::string version;     ///< ETag, or the time of the last change
  std::string version_by;  ///< which of these it is
  unsigned char* to = nullptr;
  std::size_t room = 0, got = 0;
  CURL* handle = nullptr;

  /// A header's value, without blanks and the line's end.
  static std::string value_of(std::string_view line) {
    line.remove_prefix(std::min(line.size(), line.find(':') + 1));
    while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
    while (!line.empty() && line.back() <= ' ') line.remove_suffix(1);
    return std::string(line);
  }

  void hear(std::string_view line) {
    const std::string name = lower_case(std::string(line.substr(0, line.find(':'))));
    if (name == "etag" || (name == "last-modified" && version_by != "etag")) {
      version = value_of(line);
      version_by = name;
    }
    if (name != "content-range") return;
    const std::string range = value_of(line);
    const char* const begin = range.data() + std::min(range.size(), range.find('/') + 1);
    std::from_chars(begin, range.data() + range.size(), size);
  }
};

std::size_t hear_header(char* line, std::size_t one, std::size_t count, void* answer) {
  auto& heard = *static_cast<Answer*>(answer);
  const std::string_view text(line, one * count);
  if (text.starts_with("HTTP/")) heard.size = 0, heard.version.clear(), heard.version_by.clear();
  heard.hear(text);
  return one * count;
}

/// Keeps a part; anything else, as the whole of a large file, is not waited for.
std::size_t keep_body(char* bytes, std::size_t one, std::size_t count, void* answer) {
  auto& heard = *static_cast<Answer*>(answer);
  curl_easy_getinfo(heard.handle, CURLINFO_RESPONSE_CODE, &heard.status);
  if (heard.status != HAS_PART || heard.got + one * count > heard.room) return 0;
  std::memcpy(heard.to + heard.got, bytes, one * count);
  heard.got += one * count;
  return one * count;
}

/// Whether the same request may succeed a moment later.
bool may_pass(CURLcode code, long status) {
  constexpr long SERVER_FAILS = 500, TOO_MANY = 429;
  return code == CURLE_COULDNT_CONNECT || code == CURLE_OPERATION_TIMEDOUT || code == CURLE_RECV_ERROR ||
         code == CURLE_SEND_ERROR || code == CURLE_GOT_NOTHING || code == CURLE_PARTIAL_FILE ||
         status >= SERVER_FAILS || status == TOO_MANY;
}

struct Close {
  void operator()(CURL* handle) const { curl_easy_cleanup(handle); }
};
using Handle = std::unique_ptr<CURL, Close>;

/// Handles that no request uses now. Each keeps its connections, so that tiles of one server need none of their own.
class IdleHandles {
 public:
  Handle take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return Handle(curl_easy_init());
    Handle handle = std::move(idle_.back());
    idle_.pop_back();
    curl_easy_reset(handle.get());
    return handle;
  }
  void give(Handle handle) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(handle));
  }

 private:
  std::mutex mutex_;
  std::vector<Handle> idle_;
};

IdleHandles& idle_handles() {
  static IdleHandles handles;
  return handles;
}

class RemoteSource : public ByteSource {
 public:
  explicit RemoteSource(std::string url) : url_(std::move(url)) {
    block_.resize(BLOCK_BYTES);
    const Answer first = ask(0, block_.data(), block_.size());
    size_ = first.size;
    version_ = first.version;
    if (first.status == BEHIND_END || size_ == 0)
      refuse("the file is empty, or its server does not say how long it is");
    block_.resize(first.got);
  }

  [[nodiscard]] std::uint64_t size() const override { return size_; }
  [[nodiscard]] bool is_near() const override { return false; }

  [[nodiscard]] std::size_t read(std::uint64_t offset, unsigned char* to, std::size_t count) override {
    if (offset >= size_) return 0;
    const std::lock_guard lock(mutex_);
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(count, size_ - offset));
    std::size_t done = take_from_block(offset, to, wanted);
    if (wanted - done >= BLOCK_BYTES) {
      const BytePart rest{offset + done, to + done, wanted - done};
      return read_parts({&rest, 1}) ? wanted : done;
    }
    while (done < wanted) {
      next_block(offset + done);
      const std::size_t got = take_from_block(offset + done, to + done, wanted - done);
      if (got == 0) refuse("it could not be read to its end");
      done += got;
    }
    return done;
  }

  [[nodiscard]] bool read_parts(std::span<const BytePart> parts) override {
    std::vector<BytePart> requests;
    for (const BytePart& part : parts)
      for (std::size_t at = 0; at < part.count; at += REQUEST_BYTES)
        requests.push_back({part.offset + at, part.to + at, std::min(REQUEST_BYTES, part.count - at)});
    request_together(requests);
    return true;
  }

 private:
  /// What a small read takes at once, and how much it takes of a file that is read front to back.
  static constexpr std::size_t BLOCK_BYTES = std::size_t{1} << 16U, MOST_BLOCK_BYTES = std::size_t{1} << 22U;

  static constexpr std::size_t REQUEST_BYTES = std::size_t{1}
                                               << 20U;  ///< more are asked for by several requests

  /// Some wait at a time: an answer comes after the way there and back, however short it is.
  void request_together(std::span<const BytePart> requests) const {
    constexpr std::size_t MOST_WAITING = 8;
    std::atomic<std::size_t> next{0};
    std::vector<std::future<void>> waiting;
    for (std::size_t i = 0; i < std::min(requests.size(), MOST_WAITING); ++i)
      waiting.push_back(std::async(std::launch::async, [&] {
        try {
          for (std::size_t at = next++; at < requests.size(); at = next++)
            static_cast<void>(part(requests[at].offset, requests[at].to, requests[at].count));
        } catch (...) {
          next = requests.size();  // the others ask for no more
          throw;
        }
      }));
    for (const std::future<void>& one : waiting) one.wait();
    for (std::future<void>& one : waiting) one.get();
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(ExitCode::input_unreadable, one_line(url_ + ": " + what));
  }

  /// What every request has.
  void set_options(CURL* handle, char* said) const {
    constexpr long CONNECT_S = 20, STALLED_S = 30, REDIRECTS = 5;
    const bool is_safe = url_.starts_with("https:");
    curl_easy_setopt(handle, CURLOPT_URL, url_.c_str());
    curl_easy_setopt(handle, CURLOPT_PROTOCOLS_STR, "http,https");
    curl_easy_setopt(handle, CURLOPT_REDIR_PROTOCOLS_STR, is_safe ? "https" : "http,https");
    curl_easy_setopt(handle, CURLOPT_FOLLOWLOCATION, 1L);
    curl_easy_setopt(handle, CURLOPT_MAXREDIRS, REDIRECTS);
    curl_easy_setopt(handle, CURLOPT_NOSIGNAL, 1L);
    curl_easy_setopt(handle, CURLOPT_CONNECTTIMEOUT, CONNECT_S);
    curl_easy_setopt(handle, CURLOPT_LOW_SPEED_LIMIT, 1L);
    curl_easy_setopt(handle, CURLOPT_LOW_SPEED_TIME, STALLED_S);
    curl_easy_setopt(handle, CURLOPT_USERAGENT, "splatray");
    curl_easy_setopt(handle, CURLOPT_ERRORBUFFER, said);
    curl_easy_setopt(handle, CURLOPT_HEADERFUNCTION, hear_header);
    curl_easy_setopt(handle, CURLOPT_WRITEFUNCTION, keep_body);
    if (const char* bundle = std::getenv("CURL_CA_BUNDLE")) curl_easy_setopt(handle, CURLOPT_CAINFO, bundle);
  }

  /// Bytes of the part from `offset` on. Throws where the server gives another part, or one of another file.
  std::size_t part(std::uint64_t offset, unsigned char* to, std::size_t count) const {
    const Answer answer = ask(offset, to, count);
    if (answer.size != size_ || answer.version != version_)
      refuse("it has changed on its server while it was read");
    if (answer.got != count) refuse("it could not be read to its end");
    return count;
  }

  void next_block(std::uint64_t offset) {
    const bool goes_on = offset == block_offset_ + block_.size();
    const std::size_t usual = goes_on ? std::min(2 * block_.size(), MOST_BLOCK_BYTES) : BLOCK_BYTES;
    block_.resize(
        static_cast<std::size_t>(std::min<std::uint64_t>(std::max(usual, BLOCK_BYTES), size_ - offset)));
    block_offset_ = offset;
    static_cast<void>(part(offset, block_.data(), block_.size()));
  }

  std::size_t take_from_block(std::uint64_t offset, unsigned char* to, std::size_t count) const {
    if (offset < block_offset_ || offset >= block_offset_ + block_.size()) return 0;
    const auto at = static_cast<std::size_t>(offset - block_offset_);
    const std::size_t got = std::min(count, block_.size() - at);
    std::memcpy(to, block_.data() + at, got);
    return got;
  }

  /// Asks for a part until it is given. The file's begin may be asked for before its size is known.
  Answer ask(std::uint64_t offset, unsigned char* to, std::size_t count) const {
    constexpr int TRIES = 3;
    for (int tried = 1;; ++tried) {
      std::array<char, CURL_ERROR_SIZE> said{};
      const auto [code, answer] = request(offset, to, count, said.data());
      if (code == CURLE_OK && (answer.status == HAS_PART || answer.status == BEHIND_END)) return answer;
      if (tried == TRIES || !may_pass(code, answer.status))
        refuse(sentence(code, answer.status, said.data()));
      std::this_thread::sleep_for(std::chrono::milliseconds(400 * tried));
    }
  }

  /// `said`: room for what libcurl says.
  std::pair<CURLcode, Answer> request(std::uint64_t offset, unsigned char* to, std::size_t count,
                                      char* said) const {
    Handle handle = idle_handles().take();
    if (handle == nullptr) refuse("libcurl could not be started");
    set_options(handle.get(), said);
    Answer answer;
    answer.to = to;
    answer.room = count;
    answer.handle = handle.get();
    const std::string range = std::to_string(offset) + "-" + std::to_string(offset + count - 1);
    curl_easy_setopt(handle.get(), CURLOPT_RANGE, range.c_str());
    curl_easy_setopt(handle.get(), CURLOPT_HEADERDATA, &answer);
    curl_easy_setopt(handle.get(), CURLOPT_WRITEDATA, &answer);
    const CURLcode code = curl_easy_perform(handle.get());
    curl_easy_getinfo(handle.get(), CURLINFO_RESPONSE_CODE, &answer.status);
    idle_handles().give(std::move(handle));
    return {code, answer};
  }

  static std::string sentence(CURLcode code, long status, const char* heard) {
    constexpr long WHOLE = 200, NOT_FOUND = 404, GONE = 410, FORBIDDEN = 403, UNAUTHORIZED = 401;
    const std::string said = heard[0] != '\0' ? heard : curl_easy_strerror(code);
    if (code == CURLE_PEER_FAILED_VERIFICATION || code == CURLE_SSL_CACERT_BADFILE)
      return "found a certificate that cannot be trusted (" + said +
             "), expected one of a known authority (CURL_CA_BUNDLE names a file of others)";
    if (code == CURLE_TOO_MANY_REDIRECTS) return "found more than 5 redirects, expected the file";
    if (code == CURLE_UNSUPPORTED_PROTOCOL)
      return "found a redirect away from https, expected the file (" + said + ")";
    if (status == WHOLE)
      return "found a server that gives no parts of files, expected one with ranges: download the file";
    if (status == NOT_FOUND || status == GONE) return "no such file on this server";
    if (status == FORBIDDEN || status == UNAUTHORIZED)
      return "found a server that does not give it (HTTP " + std::to_string(status) +
             "), expected to be allowed";
    if (code == CURLE_OK || status >= 400)
      return "found the answer HTTP " + std::to_string(status) + ", expected 206";
    return "its server does not answer (" + said + ")";
  }

  std::string url_;
  std::mutex mutex_;
  std::uint64_t size_ = 0;
  std::string version_;
  std::vector<unsigned char> block_;  ///< a part that is kept, as small reads follow one another
  std::uint64_t block_offset_ = 0;
};

}  // namespace
}  // namespace splatray

void splatray_open_remote(const std::string& url, std::unique_ptr<splatray::ByteSource>& source) {
  static const CURLcode started = curl_global_init(CURL_GLOBAL_DEFAULT);
  if (started != CURLE_OK)
    throw splatray::Error(splatray::ExitCode::input_unreadable, url + ": libcurl could not be started");
  source = std::make_unique<splatray::RemoteSource>(url);
}
