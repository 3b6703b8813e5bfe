#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace hiac {

/// An immutable array that shares its storage: the elements of a vector moved into it, or a part of
/// a memory-mapped file. Copying the array copies no elements. The storage lives as long as the
/// last SharedArray that refers to it.
template <typename T>
class SharedArray {
 public:
  SharedArray() = default;

  /// Takes ownership of the vector's elements.
  SharedArray(
      std::vector<T>&& elements) {  // NOLINT(google-explicit-constructor): a value is a value
    auto owner = std::make_shared<const std::vector<T>>(std::move(elements));
    view_ = std::span<const T>(*owner);
    owner_ = std::move(owner);
  }

  /// Refers to `view`, whose storage `owner` keeps alive.
  SharedArray(std::span<const T> view, std::shared_ptr<const void> owner)
      : view_(view), owner_(std::move(owner)) {}

  [[nodiscard]] std::span<const T> view() const { return view_; }
  [[nodiscard]] const T* data() const { return view_.data(); }
  [[nodiscard]] std::size_t size() const { return view_.size(); }
  [[nodiscard]] bool empty() const { return view_.empty(); }
  const T& operator[](std::size_t i) const { return view_[i]; }
  [[nodiscard]] auto begin() const { return view_.begin(); }
  [[nodiscard]] auto end() const { return view_.end(); }

 private:
  std::span<const T> view_;
  std::shared_ptr<const void> owner_;
};

}  // namespace hiac
