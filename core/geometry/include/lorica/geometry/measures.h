#pragma once

/// \file
/// Lengths, areas and volumes of meshes, summed in double precision in triangle order. Cost: one pass.

#include <span>

#include "lorica/geometry/triangle_mesh.h"

namespace lorica::geometry {

/// Box of the points; empty (isEmpty()) when there are none.
Box3d bounds(std::span<const Vec3f> points);

/// Surface area, m2.
double area(const TriangleMesh& mesh);

/// A third of the area of the triangles around each vertex, m2.
std::vector<double> vertexAreas(const TriangleMesh& mesh);

/// Volume by the divergence theorem, m3; negative when the mesh is inside out, meaningless when it is open.
double signedVolume(const TriangleMesh& mesh);

/// Centroid of the enclosed volume; of the surface when the volume is too thin to tell.
Vec3d centroid(const TriangleMesh& mesh);

/// Area-weighted unit vertex normals of the positions given; zero where a vertex has no area around it.
std::vector<Vec3f> vertexNormals(std::span<const Vec3f> positions, std::span<const Triangle> triangles);

}  // namespace lorica::geometry
