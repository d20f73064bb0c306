// Directions towards the environment, chosen as often as light comes from them. Needs `frame`, environment.glsl and
// sky_word(index) of the sky table (engine/scene/sky/sky_table.h): for each row of cells how often, of 2^32 times, a row above it is
// chosen; then for each cell how often, of 2^32 times that its row is, one to its left.
#ifndef SPLATRAY_SKY_GLSL
#define SPLATRAY_SKY_GLSL
#include "light/environment.glsl"
#include "light/sampling.glsl"

const float TWO_PI_SQUARED = 19.7392088f;

/// The last of the table's entries begin .. begin + count - 1, which rise from 0, that is not above `key`.
uint sky_find(uint begin, uint count, uint key) {
  uint low = 0u;
  uint high = count;
  do {
    uint middle = (low + high) >> 1u;
    bool above = sky_word(begin + middle) > key;
    low = above ? low : middle;
    high = above ? middle : high;
  } while (high - low > 1u);
  return low;
}

/// The share of an entry: its distance to the next, or to 2^32 of the last.
float sky_share(uint begin, uint count, uint entry) {
  uint share = (entry + 1u < count ? sky_word(begin + entry + 1u) : 0u) - sky_word(begin + entry);
  return float(share) * 2.3283064e-10f;
}

/// A number in [0, 1) anew from what chose the entry.
float sky_again(uint begin, uint entry, uint key, float share) {
  float above = float(key - sky_word(begin + entry)) * 2.3283064e-10f;
  return min(above / share, 0.99999994f);
}

/// The probability per solid angle of a cell's choice, for a direction of the environment's own frame.
float sky_cell_pdf(float row_share, float column_share, vec3 dir) {
  float sine = sqrt(max(1.0f - dir.y * dir.y, 1e-12f));
  return row_share * column_share * float(frame.sky_width * frame.sky_height) / (TWO_PI_SQUARED * sine);
}

/// A direction of the world; `at` is its environment_position(), `pdf` per solid angle.
vec3 sky_sample(vec2 random, OUT(vec2) at, OUT(float) pdf) {
  uint key_row = uint(random.y * 16777216.0f) << 8u;
  uint key_column = uint(random.x * 16777216.0f) << 8u;
  uint row = sky_find(0u, frame.sky_height, key_row);
  uint begin = frame.sky_height + row * frame.sky_width;
  uint column = sky_find(begin, frame.sky_width, key_column);
  float row_share = sky_share(0u, frame.sky_height, row);
  float column_share = sky_share(begin, frame.sky_width, column);
  at.x = (float(column) + sky_again(begin, column, key_column, column_share)) / float(frame.sky_width);
  at.y = (float(row) + sky_again(0u, row, key_row, row_share)) / float(frame.sky_height);
  float phi = TWO_PI * (at.x - 0.5f);
  float cosine = cos(PI * at.y);
  float sine = sqrt(max(1.0f - cosine * cosine, 0.0f));
  vec3 dir = vec3(sine * sin(phi), cosine, -sine * cos(phi));
  pdf = sky_cell_pdf(row_share, column_share, dir);
  return from_environment(dir);
}

/// sky_sample's probability per solid angle of a direction of the environment's own frame, whose environment_position() is `at`.
float sky_pdf(vec3 own, vec2 at) {
  uint row = min(uint(at.y * float(frame.sky_height)), frame.sky_height - 1u);
  uint column = min(uint(at.x * float(frame.sky_width)), frame.sky_width - 1u);
  uint begin = frame.sky_height + row * frame.sky_width;
  return sky_cell_pdf(sky_share(0u, frame.sky_height, row), sky_share(begin, frame.sky_width, column), own);
}

#endif
