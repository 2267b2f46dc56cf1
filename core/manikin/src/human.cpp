#include "lorica/manikin/human.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "lorica/base/error.h"
#include "lorica/human/joint_roles.h"
#include "lorica/manikin/task_clips.h"

namespace lorica::manikin {

namespace {

constexpr std::string_view kMark = "LORICAHU";

std::vector<human::Clip> clipsOf(const Body& body) {
  return taskClips(body.skeleton, human::findRoles(body.skeleton), measuredOn(body));
}

/// FNV-1a, against bytes that changed on the disk.
std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t sum = 14695981039346656037ULL;
  for (const char c : bytes) {
    sum = (sum ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  return sum;
}

static_assert(std::endian::native == std::endian::little, "kept humans are little-endian");

class Writer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  void put(const std::string& text) {
    put(static_cast<std::uint64_t>(text.size()));
    bytes_ += text;
  }
  /// Elements without pointers, one after the other.
  template <class Range>
  void putAll(const Range& range) {
    put(static_cast<std::uint64_t>(range.size()));
    bytes_.append(reinterpret_cast<const char*>(range.data()), range.size() * sizeof(*range.data()));
  }
  void put(const geometry::TriangleMesh& mesh) {
    putAll(mesh.positions);
    putAll(mesh.triangles);
  }
  void put(const human::SkinWeights& weights) {
    put(static_cast<std::uint64_t>(weights.influences));
    putAll(weights.joints);
    putAll(weights.weights);
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  [[noreturn]] void fail() const { throw base::InputError(name_, "", "is damaged; remove the file, it is made anew"); }
  void require(bool condition) const {
    if (!condition) {
      fail();
    }
  }
  template <class T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    require(bytes_.size() - at_ >= sizeof(T));
    T value;
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }
  std::size_t count(std::size_t each) {
    const auto wanted = get<std::uint64_t>();
    require(wanted <= (bytes_.size() - at_) / each);
    return static_cast<std::size_t>(wanted);
  }
  std::string text() {
    const std::size_t size = count(1);
    at_ += size;
    return std::string(bytes_.substr(at_ - size, size));
  }
  template <class Range>
  void getAll(Range& range) {
    const std::size_t size = count(sizeof(*range.data()));
    range.resize(size);
    if (size > 0) {
      std::memcpy(static_cast<void*>(range.data()), bytes_.data() + at_, size * sizeof(*range.data()));
    }
    at_ += size * sizeof(*range.data());
  }
  geometry::TriangleMesh mesh() {
    geometry::TriangleMesh mesh;
    getAll(mesh.positions);
    getAll(mesh.triangles);
    for (const geometry::Triangle& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) {
        require(corner < mesh.positions.size());
      }
    }
    return mesh;
  }
  human::SkinWeights weights(std::size_t vertices, std::size_t joints) {
    human::SkinWeights weights;
    weights.influences = static_cast<std::size_t>(get<std::uint64_t>());
    getAll(weights.joints);
    getAll(weights.weights);
    require(weights.influences > 0 && weights.influences <= 16 && weights.vertices() == vertices &&
            weights.joints.size() == vertices * weights.influences && weights.weights.size() == weights.joints.size());
    for (const std::uint32_t joint : weights.joints) {
      require(joint < joints);
    }
    return weights;
  }
  bool atEnd() const { return at_ == bytes_.size(); }

 private:
  std::string_view bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
};

void write(Writer& writer, const ArmorPiece& piece) {
  writer.put(piece.name);
  writer.put(piece.mesh);
  writer.put(static_cast<std::uint8_t>(piece.carriage == armor::Carriage::skinned));
  writer.put(static_cast<std::uint8_t>(piece.weights.has_value()));
  if (piece.weights) {
    writer.put(*piece.weights);
  }
  writer.put(piece.material);
  writer.put(piece.arealDensity);
  writer.put(piece.area);
  writer.put(piece.mass);
  writer.put(static_cast<std::uint8_t>(piece.protecting));
  writer.put(piece.source);
}

ArmorPiece readPiece(Reader& reader, std::size_t joints) {
  ArmorPiece piece;
  piece.name = reader.text();
  piece.mesh = reader.mesh();
  piece.carriage = reader.get<std::uint8_t>() != 0 ? armor::Carriage::skinned : armor::Carriage::rigid;
  if (reader.get<std::uint8_t>() != 0) {
    piece.weights = reader.weights(piece.mesh.positions.size(), joints);
  }
  piece.material = reader.text();
  piece.arealDensity = reader.get<double>();
  piece.area = reader.get<double>();
  piece.mass = reader.get<double>();
  piece.protecting = reader.get<std::uint8_t>() != 0;
  piece.source = reader.text();
  return piece;
}

}  // namespace

Human makeHuman(const human::Person& person, base::Threads threads, const base::Progress& progress) {
  Human human;
  human.body = makeBody(person, threads, progress.part(0.0, 0.4));
  progress.check();
  progress.report(0.4);
  OrganOptions options;
  options.threads = threads;
  human.organs = organsOf(human.body, options, progress.part(0.4, 0.8));
  progress.check();
  progress.report(0.8);
  human.systems = armorOf(human.body, threads, progress.part(0.8, 1.0));
  human.clips = clipsOf(human.body);
  progress.report(1.0);
  return human;
}

std::string humanBytes(const Human& human) {
  Writer writer;
  const human::Person& person = human.body.person;
  writer.put(static_cast<std::uint8_t>(person.sex == human::Sex::female));
  writer.put(person.stature);
  writer.put(person.mass);
  writer.put(human.body.skin);
  writer.put(human.body.weights);
  writer.put(static_cast<std::uint64_t>(human.body.skeleton.size()));
  for (const human::Joint& joint : human.body.skeleton.joints()) {
    writer.put(joint.name);
    writer.put(joint.parent ? static_cast<std::int64_t>(joint.parent->value) : std::int64_t{-1});
    for (int axis = 0; axis < 3; ++axis) {
      writer.put(joint.rest.translation[axis]);
    }
  }
  writer.put(static_cast<std::uint64_t>(human.organs.size()));
  for (const Organ& organ : human.organs) {
    writer.put(organ.name);
    writer.put(organ.mesh);
    writer.put(organ.targetVolume);
    writer.put(organ.density);
    writer.put(organ.source);
  }
  writer.put(static_cast<std::uint64_t>(human.systems.size()));
  for (const ArmorSystem& system : human.systems) {
    writer.put(system.name);
    writer.put(static_cast<std::uint64_t>(system.pieces.size()));
    for (const ArmorPiece& piece : system.pieces) {
      write(writer, piece);
    }
  }
  const std::string body = writer.take();
  Writer head;
  head.put(kHumanVersion);
  head.put(checksum(body));
  return std::string(kMark) + head.take() + body;
}

Human readHuman(std::string_view bytes, const std::string& name) {
  Reader head(bytes, name);
  head.require(bytes.size() >= kMark.size() + 12 && bytes.substr(0, kMark.size()) == kMark);
  bytes.remove_prefix(kMark.size());
  Reader front(bytes, name);
  if (front.get<std::uint32_t>() != kHumanVersion) {
    throw base::InputError(name, "", "was made by another version of the program");
  }
  const auto sum = front.get<std::uint64_t>();
  bytes.remove_prefix(12);
  Reader reader(bytes, name);
  reader.require(checksum(bytes) == sum);

  Human human;
  human.body.person.sex = reader.get<std::uint8_t>() != 0 ? human::Sex::female : human::Sex::male;
  human.body.person.stature = reader.get<double>();
  human.body.person.mass = reader.get<double>();
  human.body.skin = reader.mesh();
  // The weights stand before the joints, so their joints are checked when those are known.
  human.body.weights = reader.weights(human.body.skin.positions.size(), 1024);
  const std::size_t joints = reader.count(sizeof(double));
  std::vector<human::Joint> all(joints);
  for (std::size_t j = 0; j < joints; ++j) {
    all[j].name = reader.text();
    const auto parent = reader.get<std::int64_t>();
    reader.require(parent < static_cast<std::int64_t>(j));
    if (parent >= 0) {
      all[j].parent = human::JointIndex{static_cast<std::size_t>(parent)};
    }
    for (int axis = 0; axis < 3; ++axis) {
      all[j].rest.translation[axis] = reader.get<double>();
    }
  }
  for (const std::uint32_t joint : human.body.weights.joints) {
    reader.require(joint < joints);
  }
  human.body.skeleton = human::Skeleton(std::move(all));
  const std::size_t organs = reader.count(1);
  for (std::size_t o = 0; o < organs; ++o) {
    Organ organ;
    organ.name = reader.text();
    organ.mesh = reader.mesh();
    organ.targetVolume = reader.get<double>();
    organ.density = reader.get<double>();
    organ.source = reader.text();
    human.organs.push_back(std::move(organ));
  }
  const std::size_t systems = reader.count(1);
  for (std::size_t s = 0; s < systems; ++s) {
    ArmorSystem system;
    system.name = reader.text();
    const std::size_t pieces = reader.count(1);
    for (std::size_t p = 0; p < pieces; ++p) {
      system.pieces.push_back(readPiece(reader, joints));
    }
    human.systems.push_back(std::move(system));
  }
  reader.require(reader.atEnd());
  human.clips = clipsOf(human.body);
  return human;
}

}  // namespace lorica::manikin
