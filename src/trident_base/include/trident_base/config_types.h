// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace trident {

/// Legal values of a number, or of each number in a list or map. NaN is never legal; an infinite
/// value only where `or_infinite()` was asked for.
struct Range {
  double lo = -std::numeric_limits<double>::infinity();  ///< -inf: no lower end
  double hi = std::numeric_limits<double>::infinity();   ///< +inf: no upper end
  bool lo_open = false;                                  ///< lo itself is not legal.
  bool hi_open = false;                                  ///< hi itself is not legal.
  bool infinite = false;  ///< whether +-inf is legal where the ends allow it

  static constexpr Range any() { return {}; }                  ///< all finite numbers
  static constexpr Range at_least(double lo) { return {lo}; }  ///< [lo, inf)
  /// (-inf, hi].
  static constexpr Range at_most(double hi) {
    return {-std::numeric_limits<double>::infinity(), hi};
  }
  static constexpr Range non_negative() { return at_least(0.0); }  ///< [0, inf)
  /// (0, inf).
  static constexpr Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true}; }

  /// The same range with infinity among its legal values.
  constexpr Range or_infinite() const {
    Range result = *this;
    result.infinite = true;
    return result;
  }

  /// False for NaN, and for an infinity unless or_infinite() was asked for.
  bool contains(double value) const;
  /// True when neither end limits anything.
  constexpr bool is_unbounded() const {
    return lo == -std::numeric_limits<double>::infinity() &&
           hi == std::numeric_limits<double>::infinity();
  }
  /// "in [0, 1)", ">= 0", "> 0", "a finite number".
  std::string text() const;
};

/// An enum is read from YAML through a table found by argument-dependent lookup:
///   enum class Timing { kDirect, kRotors };
///   constexpr auto enum_names(Timing) {
///     return std::array{EnumName{Timing::kDirect, "direct"}, EnumName{Timing::kRotors, "rotors"}};
///   }
template <class Enum>
struct EnumName {
  Enum value;        ///< an enumerator
  const char* name;  ///< as files spell it
};
/// EnumName{Timing::kDirect, "direct"} names its enum by itself.
template <class Enum>
EnumName(Enum, const char*) -> EnumName<Enum>;

namespace config_detail {

/// Stands for any archive when a type is asked whether it can be visited.
struct ArchiveProbe {
  /// Takes whatever a visit() hands to an archive.
  template <class... Args>
  void field(Args&&...) {}
  /// See field().
  template <class... Args>
  void required(Args&&...) {}
};

/// Whether T is a struct with visit(archive); Eigen's matrices have a visit() of another meaning.
template <class T, class = void>
inline constexpr bool is_visitable_v = false;
template <class T>
inline constexpr bool is_visitable_v<
    T, std::void_t<decltype(std::declval<T&>().visit(std::declval<ArchiveProbe&>()))>> =
    std::is_class_v<T> && !std::is_base_of_v<Eigen::EigenBase<T>, T>;

/// Whether T has a validate() that a reader calls after its fields are filled.
template <class T, class = void>
inline constexpr bool is_validated_v = false;
template <class T>
inline constexpr bool
    is_validated_v<T, std::void_t<decltype(std::declval<const T&>().validate())>> = true;

/// Whether T is an enum with a table of names.
template <class T, class = void>
inline constexpr bool is_named_enum_v = false;
template <class T>
inline constexpr bool is_named_enum_v<T, std::void_t<decltype(enum_names(std::declval<T>()))>> =
    std::is_enum_v<T>;

/// Whether T is read as a number: bool is not one.
template <class T>
inline constexpr bool is_number_v = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

/// The type that a Range on a field speaks about: the innermost element of lists, maps and
/// optionals.
template <class T>
struct Element {
  using Type = T;
};
template <class T>
struct Element<std::vector<T>> : Element<T> {};
template <class T, std::size_t N>
struct Element<std::array<T, N>> : Element<T> {};
template <class T>
struct Element<std::optional<T>> : Element<T> {};
template <class T>
struct Element<std::map<std::string, T>> : Element<T> {};
template <int N>
struct Element<Eigen::Matrix<double, N, 1>> {
  using Type = double;
};

/// Whether a field of type T may be given a Range.
template <class T>
inline constexpr bool range_applies_v = is_number_v<typename Element<T>::Type>;

}  // namespace config_detail
}  // namespace trident
