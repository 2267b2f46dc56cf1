#pragma once

/// \file
/// Posed scenes out, for other programs to open: GLB, PLY and VTK PolyData.

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lorica/geometry/triangle_mesh.h"

namespace lorica::io {

enum class SceneFormat { glb, ply, vtp };

/// One structure of an exported scene.
struct SceneMesh {
  std::string name;                            ///< structure; becomes the node's name
  std::string kind;                            ///< "body", "organ" or "armor"
  std::span<const geometry::Vec3f> positions;  ///< metres
  std::span<const geometry::Triangle> triangles;
  std::array<float, 4> colour{0.8F, 0.8F, 0.8F, 1.0F};  ///< red, green, blue, opacity; 0 to 1, linear
};

/// The file's bytes. GLB: one node and mesh per structure with positions, area-weighted normals and a material.
/// PLY: binary, one mesh with vertex normals, face colours and a face property `structure` (index; the names are
/// comment lines "structure INDEX NAME"). VTP: one PolyData with cell arrays `structure` (index), `colour`, and the
/// names as the string field array `structure_names`.
/// Names are made one line. Colours are linear in GLB and sRGB bytes elsewhere, as other programs show them.
/// The same scene gives the same bytes.
/// \pre corners are below positions.size()
std::string sceneBytes(std::span<const SceneMesh> scene, SceneFormat format);

/// Numbers of the triangles of a scene, for colouring.
struct TriangleField {
  std::string name;
  std::vector<double> values;  ///< one per triangle, mesh by mesh; not a number where there is none
};

/// Numbers of the vertices of a scene.
struct VertexField {
  std::string name;
  std::vector<double> values;  ///< one per position, mesh by mesh; not a number where there is none
};

/// sceneBytes() as VTP, with an array in double precision for each field: of cells for triangles, of points for
/// vertices. \pre as sceneBytes, and a value per triangle or position of the scene
std::string fieldsVtpBytes(std::span<const SceneMesh> scene, std::span<const TriangleField> fields,
                           std::span<const VertexField> vertexFields = {});

/// sceneBytes() into a file, all or nothing. \throw base::InputError when the place cannot be written
void writeScene(std::span<const SceneMesh> scene, SceneFormat format, const std::filesystem::path& path);

/// One row of a CSV file: fields that hold a comma, a quote or a line break are quoted (RFC 4180). It ends with a
/// line feed.
std::string csvRow(std::span<const std::string> fields);

/// A table of csvRow() lines with one more column at its end, the same text in every row; the first line is the header.
std::string csvWithColumn(std::string_view csv, std::string_view name, std::string_view value);

/// A number with six decimals as a field; empty when there is none.
std::string csvNumber(std::optional<double> value);

}  // namespace lorica::io
