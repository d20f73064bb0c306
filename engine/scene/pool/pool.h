/// Arrays of a scene.
#pragma once
#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace splatray {

/// An array that many read: in memory, or lent, where it lies in a file that is mapped. Copies share their elements until one is
/// edited. As a value: one thread at a time.
template <typename Value>
class Pool {
 public:
  using value_type = Value;
  using const_iterator = const Value*;

  Pool() = default;
  Pool(std::vector<Value> values)  // NOLINT: an array as it is made
      : own_(std::make_shared<std::vector<Value>>(std::move(values))) {}
  Pool(std::initializer_list<Value> values) : Pool(std::vector<Value>(values)) {}
  /// Elements that stay as long as `lender` does.
  Pool(std::span<const Value> lent, std::shared_ptr<const void> lender)
      : lender_(std::move(lender)), lent_(lent) {}

  [[nodiscard]] const Value* data() const { return own_ ? own_->data() : lent_.data(); }
  [[nodiscard]] std::size_t size() const { return own_ ? own_->size() : lent_.size(); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] const Value* begin() const { return data(); }
  [[nodiscard]] const Value* end() const { return data() + size(); }
  [[nodiscard]] const Value& operator[](std::size_t i) const { return data()[i]; }
  [[nodiscard]] const Value& front() const { return *data(); }
  [[nodiscard]] const Value& back() const { return data()[size() - 1]; }

  /// The elements to be changed; a copy of them where they are lent or another Pool has them, too.
  [[nodiscard]] std::vector<Value>& edit() {
    if (own_ == nullptr || own_.use_count() > 1) *this = Pool(std::vector<Value>(begin(), end()));
    return *own_;
  }

  /// What keeps the elements where they are, as long as no one edits this.
  [[nodiscard]] std::shared_ptr<const void> keeper() const {
    return own_ ? std::shared_ptr<const void>(own_) : lender_;
  }

  friend bool operator==(const Pool& a, const Pool& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  std::shared_ptr<std::vector<Value>> own_;  ///< null: lent
  std::shared_ptr<const void> lender_;
  std::span<const Value> lent_;
};

}  // namespace splatray
