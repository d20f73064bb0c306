/// The C++ side of shaders/lang/language.glsl: what GLSL has built in, so that the shaders' text compiles as C++
/// with GLM. Include inside a namespace of its own (tests/trace/twin.cpp does) after <cmath>, <cstdint> and
/// glm.
#define OUT(type) type&
#define INOUT(type) type&
#define PRECISE
#define INFINITY_F (std::numeric_limits<float>::infinity())

using glm::abs;
using glm::acos;
using glm::atan;
using glm::bitCount;
using glm::bvec3;
using glm::clamp;
using glm::cross;
using glm::dot;
using glm::dvec3;
using glm::floor;
using glm::inversesqrt;
using glm::ivec3;
using glm::ivec4;
using glm::length;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using glm::reflect;
using glm::uint;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using std::cos;
using std::exp;
using std::log;
using std::pow;
using std::sin;
using std::sqrt;

inline float uintBitsToFloat(uint bits) { return std::bit_cast<float>(bits); }
inline int findLSB(uint x) { return x == 0U ? -1 : std::countr_zero(x); }
inline int findMSB(uint x) { return std::bit_width(x) - 1; }
