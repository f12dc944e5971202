// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cassert>
#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>

namespace trident {

/// A view of `size()` consecutive values that somebody else owns: the part of C++20's std::span
/// that we need, for C++17. Cheap to copy; valid as long as the values stay where they are. As with
/// a pointer, a const Span<T> still lets its values be written; Span<const T> does not.
///
/// Preconditions on indices and counts are the caller's duty; they are asserted in debug builds.
template <class T>
class Span {
  // Values must lie next to each other, and a pointer to them must become a T* without a change of
  // type other than added const: Derived* to Base* would step by the wrong size.
  template <class Values>
  using ElementOf = std::remove_pointer_t<decltype(std::data(std::declval<Values&>()))>;
  template <class Values>
  using EnableFor = std::enable_if_t<!std::is_same_v<std::remove_cv_t<Values>, Span> &&
                                     std::is_convertible_v<ElementOf<Values> (*)[], T (*)[]>>;

 public:
  using element_type = T;
  using value_type = std::remove_cv_t<T>;
  using size_type = std::size_t;
  using difference_type = std::ptrdiff_t;
  using pointer = T*;
  using reference = T&;
  using iterator = T*;

  constexpr Span() = default;
  /// The `size` values from `data` on; `data` may be nullptr when size is 0.
  constexpr Span(T* data, std::size_t size) : data_(data), size_(size) {}

  /// Views a whole std::vector, std::array, C array, string or other span. Like a pointer it may
  /// add const (Span<double> to Span<const double>), but not remove it or convert the values.
  template <class Values, class = EnableFor<Values>>
  constexpr Span(Values& values) : Span(std::data(values), std::size(values)) {}
  template <class Values, class = EnableFor<const Values>>
  constexpr Span(const Values& values) : Span(std::data(values), std::size(values)) {}

  constexpr T* data() const { return data_; }  ///< of the first value; may be nullptr when empty
  constexpr std::size_t size() const { return size_; }  ///< number of values, not bytes
  constexpr bool empty() const { return size_ == 0; }   ///< front() and back() need a value
  constexpr T* begin() const { return data_; }          ///< for range-based loops and algorithms
  constexpr T* end() const { return data_ + size_; }    ///< behind the last value

  /// index < size().
  constexpr T& operator[](std::size_t index) const {
    assert(index < size_);
    return data_[index];
  }
  constexpr T& front() const { return (*this)[0]; }         ///< of a span that is not empty
  constexpr T& back() const { return (*this)[size_ - 1]; }  ///< of a span that is not empty

  /// The first `count` values; count <= size().
  constexpr Span first(std::size_t count) const {
    assert(count <= size_);
    return {data_, count};
  }
  /// The values from `offset` on; offset <= size().
  constexpr Span subspan(std::size_t offset) const {
    assert(offset <= size_);
    return {data_ + offset, size_ - offset};
  }
  /// `count` values from `offset` on; offset + count <= size().
  constexpr Span subspan(std::size_t offset, std::size_t count) const {
    return subspan(offset).first(count);
  }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Span(vector), Span(array), Span(pointer, size): the element type follows from the argument.
template <class Values>
Span(Values& values) -> Span<std::remove_pointer_t<decltype(std::data(values))>>;

}  // namespace trident
