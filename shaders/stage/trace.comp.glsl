#version 450
#extension GL_GOOGLE_include_directive : require
// A tile of an image: whole paths or, on CPU devices, a wavefront stage of one sample's; in STAGE_AOV what the ray through each
// pixel's centre hits.
#include "scene/bindings.glsl"
#include "stage/trace.glsl"

void main() {
  read_frame();
  Work work;
  if (!find_work(work)) return;
  trace_work(work);
}
