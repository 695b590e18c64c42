// src/features/lanes.h: vectors of fixed length, for the files that are compiled once for each
// instruction set (kernels.h): everything here is local to the file that includes it.
#pragma once

#include <cstdint>

namespace softscope {
namespace {

typedef float Float8 __attribute__((vector_size(32)));
typedef std::int32_t Int8 __attribute__((vector_size(32)));
typedef std::uint8_t Bytes8 __attribute__((vector_size(8)));
typedef std::uint16_t Words8 __attribute__((vector_size(16)));
typedef std::uint16_t Words16 __attribute__((vector_size(32)));
typedef char Bytes32 __attribute__((vector_size(32)));
typedef long long Quads __attribute__((vector_size(32)));

template <class Vector, class Value>
inline Vector load(const Value* from) {
  Vector values;
  __builtin_memcpy(&values, from, sizeof(values));
  return values;
}
template <class Vector, class Value>
inline void store(Value* to, const Vector& values) {
  __builtin_memcpy(to, &values, sizeof(values));
}

}  // namespace
}  // namespace softscope
