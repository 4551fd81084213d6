#pragma once

#include <string_view>

/// The files of data/ as text, built in by embed_tables.cmake. Private to this folder.
namespace rowland::colour::embedded {

extern const std::string_view kCie1931;
extern const std::string_view kMallett2019;
extern const std::string_view kIlluminantA;
extern const std::string_view kIlluminantD65;
extern const std::string_view kIlluminantE;
extern const std::string_view kIlluminantF2;
extern const std::string_view kIlluminantF11;
extern const std::string_view kIlluminantLedB3;
extern const std::string_view kMetalAl;
extern const std::string_view kMetalAg;
extern const std::string_view kMetalAu;
extern const std::string_view kMetalCu;

}  // namespace rowland::colour::embedded
