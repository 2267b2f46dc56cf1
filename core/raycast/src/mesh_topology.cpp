#include "lorica/raycast/mesh_topology.h"

namespace lorica::raycast {

std::shared_ptr<const MeshTopology> makeTopology(const geometry::TriangleMesh& mesh) {
  auto topology = std::make_shared<MeshTopology>();
  geometry::MeshAudit audit = geometry::audit(mesh);
  topology->triangles = mesh.triangles;
  topology->vertices = mesh.positions.size();
  topology->componentOf = std::move(audit.componentOf);
  topology->openEdge = std::move(audit.openEdge);
  for (const geometry::Component& component : audit.components) {
    topology->closed.push_back(component.closed);
    topology->hasOpenEdges = topology->hasOpenEdges || !component.closed;
  }

  std::vector<std::uint32_t>& start = topology->ringStart;
  start.assign(mesh.positions.size() + 1, 0);
  for (const geometry::Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      ++start[vertex + 1];
    }
  }
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    start[v + 1] += start[v];
  }
  topology->ring.resize(mesh.triangles.size() * 3);
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t vertex : mesh.triangles[t]) {
      topology->ring[next[vertex]++] = static_cast<std::uint32_t>(t);
    }
  }
  return topology;
}

}  // namespace lorica::raycast
