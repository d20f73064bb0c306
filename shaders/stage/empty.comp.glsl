#version 450
#extension GL_GOOGLE_include_directive : require
// Pixels that no leaf projects to (engine/image/footprint.h): all their rays meet the environment. A program of its own, as drivers
// take as long to read one with the walk in it whether the walk is used or not.
#include "scene/bindings.glsl"
#include "stage/empty.glsl"

void main() {
  read_frame();
  uvec2 in_tile = uvec2(0u);
  if (!find_pixel(in_tile)) return;
  miss_all(in_tile);
}
