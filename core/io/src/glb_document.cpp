#include "glb_document.h"

#include <array>

#include "lorica/base/error.h"

namespace lorica::io {

namespace {

void appendWord(std::string& file, std::uint64_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  std::array<char, sizeof word> raw{};
  std::memcpy(raw.data(), &word, sizeof word);
  file.append(raw.data(), raw.size());
}

}  // namespace

std::size_t GlbDocument::addRaw(std::string_view raw, int componentType, std::size_t count, const char* type,
                                GlbUse use) {
  LORICA_CHECK(!raw.empty() && raw.size() % 4 == 0, "glTF has no empty accessors, and ours fill whole words");
  Json view{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", raw.size()}};
  if (use != GlbUse::other) {
    view["target"] = use == GlbUse::attribute ? 34962 : 34963;
  }
  views_.push_back(std::move(view));
  binary_ += raw;
  accessors_.push_back(
      {{"bufferView", views_.size() - 1}, {"componentType", componentType}, {"count", count}, {"type", type}});
  return accessors_.size() - 1;
}

void GlbDocument::setRange(std::size_t accessor, const Json& least, const Json& greatest) {
  accessors_.at(accessor)["min"] = least;
  accessors_.at(accessor)["max"] = greatest;
}

std::string GlbDocument::bytes() const {
  Json root{{"asset", {{"version", "2.0"}, {"generator", "Lorica"}}}, {"scene", 0}};
  root["scenes"] = Json::array({roots.empty() ? Json::object() : Json{{"nodes", roots}}});
  for (const auto& [name, list] : {std::pair{"nodes", &nodes},
                                   {"meshes", &meshes},
                                   {"materials", &materials},
                                   {"skins", &skins},
                                   {"animations", &animations},
                                   {"accessors", &accessors_},
                                   {"bufferViews", &views_}}) {
    if (!list->empty()) {
      root[name] = *list;
    }
  }
  if (!binary_.empty()) {
    root["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
  }
  std::string json = root.dump(-1, ' ', false, Json::error_handler_t::replace);
  json.append((4 - json.size() % 4) % 4, ' ');
  std::uint64_t length = 12 + 8 + json.size();
  length += binary_.empty() ? 0 : 8 + binary_.size();
  LORICA_CHECK(length <= UINT32_MAX, "a .glb is at most 4 GB");
  std::string file = "glTF";
  appendWord(file, 2);
  appendWord(file, length);
  appendWord(file, json.size());
  file += "JSON" + json;
  if (!binary_.empty()) {
    appendWord(file, binary_.size());
    file.append("BIN\0", 4);
    file += binary_;
  }
  return file;
}

}  // namespace lorica::io
