/// That two scenes are the same in all that a file holds.
#pragma once
#include <gtest/gtest.h>

#include "engine/scene/pool/pool_table.h"

namespace splatray {

inline void expect_same_points(const Scene& a, const Scene& b) {
  for_each_pool([&](const auto& row) { EXPECT_EQ(a.*row.pool, b.*row.pool) << row.key; });
  ASSERT_EQ(a.columns.size(), b.columns.size());
  for (std::size_t i = 0; i < a.columns.size(); ++i) {
    EXPECT_EQ(a.columns[i].name, b.columns[i].name);
    EXPECT_EQ(a.columns[i].values, b.columns[i].values) << a.columns[i].name;
  }
  ASSERT_EQ(a.stations.size(), b.stations.size());
  for (std::size_t i = 0; i < a.stations.size(); ++i) {
    const Station &one = a.stations[i], &other = b.stations[i];
    EXPECT_EQ(one.name, other.name);
    EXPECT_EQ(one.sensor_world, other.sensor_world);
    EXPECT_EQ(one.sensor_found_world, other.sensor_found_world);
    EXPECT_EQ(one.rows, other.rows);
    EXPECT_EQ(one.columns, other.columns);
    EXPECT_EQ(one.noise_world, other.noise_world);
    EXPECT_EQ(one.step_world, other.step_world);
  }
}

inline void expect_same_scene(const Scene& a, const Scene& b) {
  expect_same_points(a, b);
  EXPECT_EQ(a.root.origin_world, b.root.origin_world);
  EXPECT_EQ(a.root.unit_world, b.root.unit_world);
  EXPECT_EQ(a.build, b.build);
  EXPECT_TRUE(same_bytes(a.materials, b.materials));
  EXPECT_EQ(a.object_names, b.object_names);
  EXPECT_EQ(a.lights, b.lights);
  EXPECT_EQ(a.camera, b.camera);
  EXPECT_EQ(a.up, b.up);
  EXPECT_EQ(a.bounds_min_world, b.bounds_min_world);
  EXPECT_EQ(a.bounds_max_world, b.bounds_max_world);
  EXPECT_EQ(a.surface_area_world, b.surface_area_world);
  EXPECT_EQ(a.environment_path, b.environment_path);
  EXPECT_EQ(a.crs, b.crs);
}

}  // namespace splatray
