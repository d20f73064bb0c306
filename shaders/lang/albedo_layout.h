/// The albedo table, which engine/table makes when it is built: what one bounce on rough surfaces leaves of light that comes from
/// everywhere, by the cosine of the eye's direction (columns) and roughness, the square root of alpha (rows).
#ifndef SPLATRAY_ALBEDO_LAYOUT_H
#define SPLATRAY_ALBEDO_LAYOUT_H
#include "../layout.h"

#ifdef __cplusplus
namespace splatray {
#endif

SPLATRAY_CONST ALBEDO_COLUMNS = 48u;  ///< cosines, evenly in log(1 + cosine / alpha)
SPLATRAY_CONST ALBEDO_ROWS = 32u;     ///< roughness row / (ALBEDO_ROWS - 1)
/// Pairs, row by row: what facets that mirror all light reflect, and by how much the part of f90 in it exceeds schlick(cosine) of
/// that; the rest is f0's (Karis 2013, "Real Shading in Unreal Engine 4"). Then for each row the means of both parts over all
/// directions, weighted by cosine.
SPLATRAY_CONST ALBEDO_MEANS = 2u * ALBEDO_COLUMNS * ALBEDO_ROWS;
/// Both sides of dielectrics together: eta by eta, the root of (eta - 1) / (eta + 1) evenly to that of ALBEDO_ETA_MOST, and
/// likewise below 1.
SPLATRAY_CONST ALBEDO_GLASS = ALBEDO_MEANS + 2u * ALBEDO_ROWS;
SPLATRAY_CONST ALBEDO_ETAS = 65u;
SPLATRAY_CONST ALBEDO_WORDS = ALBEDO_GLASS + ALBEDO_COLUMNS * ALBEDO_ROWS * ALBEDO_ETAS;

#ifdef __cplusplus
}  // namespace splatray
#endif
#endif
