// What this program was built from; stands in for the header that CMake writes where there is none.
#pragma once
#if __has_include("build_info.hpp")
#include "build_info.hpp"
#else
namespace freshet::build {
inline constexpr const char* version = "unknown";
inline constexpr const char* git = "unknown";
inline constexpr const char* compiler = __VERSION__;
inline constexpr const char* flags = "unknown";
inline constexpr const char* type = "unknown";
inline constexpr const char* kokkos = "unknown";
inline constexpr const char* source_dir = ".";
}  // namespace freshet::build
#endif
