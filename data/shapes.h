/// Shapes as point clouds: area-preserving maps of the unit square. Metres; the shapes stand at the origin, y
/// up.
#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "data/oriented_points.h"
#include "data/square.h"

namespace splatray {

/// A patch of one object's surface: how large it is and how to sample it.
struct SurfacePatch {
  std::string object;  ///< name of the object, and of its point file without ".ply"
  double area = 0.0;   ///< m^2; points are shared out by area * density
  std::function<OrientedPoints(const Sampling& sampling)> make;
  double density = 1.0;  ///< points per area, relative to the model's other surfaces
};
using Model = std::vector<SurfacePatch>;

/// Sphere, normals outwards.
[[nodiscard]] OrientedPoints sphere(const Sampling& sampling, double radius);

/// Part of a torus about the y axis: the angle on the tube runs over [from, to], 0 outermost, pi/2 on top.
/// ring_radius >= tube_radius. Normals outwards.
[[nodiscard]] OrientedPoints torus(const Sampling& sampling, double ring_radius, double tube_radius,
                                   double from, double to);
[[nodiscard]] double torus_area(double ring_radius, double tube_radius, double from, double to);

/// Disc in the plane y = 0, normals +y.
[[nodiscard]] OrientedPoints disc(const Sampling& sampling, double radius);

/// Side of a cylinder about the y axis, y in [0, height], angle (from +x towards -z) in [from, to]; normals
/// outwards.
[[nodiscard]] OrientedPoints cylinder(const Sampling& sampling, double radius, double height, double from,
                                      double to);

/// Parallelogram corner + [0,1] edge_u + [0,1] edge_v, normals along cross(edge_u, edge_v).
[[nodiscard]] OrientedPoints rectangle(const Sampling& sampling, glm::dvec3 corner, glm::dvec3 edge_u,
                                       glm::dvec3 edge_v);

/// Square grid of points with about `count` points, its rows half a spacing inside the edges: for patterns
/// along the rows.
[[nodiscard]] OrientedPoints grid(const Sampling& sampling, glm::dvec3 corner, glm::dvec3 edge_u,
                                  glm::dvec3 edge_v);

/// A surface of the rectangle's area for `object`.
[[nodiscard]] SurfacePatch rectangle_surface(std::string object, glm::dvec3 corner, glm::dvec3 edge_u,
                                             glm::dvec3 edge_v);

/// The six faces of a box centred on the origin; normals outwards, or inwards for a room.
[[nodiscard]] Model box(const std::string& object, glm::dvec3 size, bool inwards);

/// A closed curve over the parameter [0, 1).
using Curve = std::function<glm::dvec3(double parameter)>;

/// Tube of `tube_radius` about a closed curve; the radius must stay below the curve's radius of curvature.
[[nodiscard]] OrientedPoints tube(const Sampling& sampling, const Curve& curve, double tube_radius);
[[nodiscard]] double tube_area(const Curve& curve, double tube_radius);

/// The (2,3) torus knot, also called trefoil, within a sphere of radius 1 about the origin, its axis along z.
[[nodiscard]] glm::dvec3 trefoil(double parameter);

/// Radius and height of a surface of revolution over the parameter [0, 1]; radius >= 0.
using Profile = std::function<glm::dvec2(double parameter)>;

/// The uniform Catmull-Rom spline through `points` (radius, height), two or more; a radius below 0 becomes 0.
[[nodiscard]] Profile spline(std::vector<glm::dvec2> points);

/// Surface of revolution of the profile about the y axis. Normals lie to the right of the profile's direction: outwards
/// where it rises.
[[nodiscard]] OrientedPoints lathe(const Sampling& sampling, const Profile& profile);
[[nodiscard]] double lathe_area(const Profile& profile);

}  // namespace splatray
