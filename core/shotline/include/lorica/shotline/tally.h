#pragma once

/// \file
/// Counts of a run. All are whole numbers, so pieces of a run add up to the whole in any order.
///
/// Met before means: earlier in the complete order of a shot's crossings (t, then mesh: skin, armor, organs).
///  - any hit: the shot crosses the structure. First hit: for the skin, it is met before any armor of the system; for a
///    region, the shot's first skin crossing lies in it and no armor is met before; for an organ, it is met before any
///    other organ of the same model; for armor, it is met before the skin.
///  - protected: armor of the system is crossed before the structure's first crossing (for a piece: another piece).

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lorica::shotline {

/// What the meshes of a traced scene stand for. Mesh 0 is the skin; then come the pieces, then the organs.
struct TargetLayout {
  std::span<const std::uint16_t> regionOfTriangle;  ///< of the skin
  std::size_t regions = 0;
  std::size_t systems = 1;                 ///< armor systems, the unarmored one first
  std::vector<std::uint32_t> pieceSystem;  ///< per piece, its system (1 and up)
  std::size_t organs = 0;
  std::vector<std::uint32_t> organClass;  ///< per organ, 0 for none, else its class from 1 up; empty: no classes
  std::size_t classes = 0;
  std::size_t models = 0;  ///< organ meshes come model by model: mesh 1 + pieces + model * organs + organ

  std::size_t pieces() const { return pieceSystem.size(); }
  std::size_t meshes() const { return 1 + pieces() + organs * models; }
};

struct Count {
  std::uint64_t any = 0;
  std::uint64_t first = 0;
  std::uint64_t shielded = 0;  ///< protected
  std::uint64_t withBody = 0;  ///< any, of the shots that also hit the body
  bool operator==(const Count&) const = default;
};

/// Counts of every structure under every system and model.
class Tally {
 public:
  Tally() = default;
  explicit Tally(const TargetLayout& layout);

  std::uint64_t shots() const { return shots_; }
  Count body(std::size_t system) const;
  Count miss() const { return {shots_ - body_.any, 0, 0, 0}; }
  Count region(std::size_t region, std::size_t system) const { return regions_[region * systems_ + system]; }
  Count organ(std::size_t organ, std::size_t model, std::size_t system) const {
    return organs_[(model * organsPerModel_ + organ) * systems_ + system];
  }
  /// Any of the organs of a model.
  Count anyOrgan(std::size_t model, std::size_t system) const { return anyOrgan_[model * systems_ + system]; }
  /// Any of the organs of a class (from 0) in a model. First hit: one of them is met before any other organ.
  Count organClass(std::size_t organClass, std::size_t model, std::size_t system) const {
    return classes_[(model * classCount_ + organClass) * systems_ + system];
  }
  /// A piece under its own system.
  Count piece(std::size_t piece) const { return pieces_[piece]; }
  /// Any of the pieces of a system.
  Count anyArmor(std::size_t system) const { return anyArmor_[system]; }

  void add(const Tally& other);
  bool operator==(const Tally&) const = default;

  /// All counts one after another, for fromNumbers().
  std::vector<std::uint64_t> numbers() const;
  /// The tally of such numbers, that of a file for one; none when there are not as many as the layout asks for, or when
  /// one is larger than what it is a part of.
  static std::optional<Tally> fromNumbers(const TargetLayout& layout, std::span<const std::uint64_t> numbers);

 private:
  friend class ShotCounter;
  template <class Self, class Use>
  static void forEachCount(Self& tally, const Use& use);
  std::size_t systems_ = 0;
  std::size_t organsPerModel_ = 0;
  std::size_t classCount_ = 0;
  std::uint64_t shots_ = 0;
  Count body_;
  std::vector<std::uint64_t> bodyShielded_;  ///< per system
  std::vector<Count> regions_;               ///< region, then system
  std::vector<Count> organs_;                ///< model, organ, then system
  std::vector<Count> anyOrgan_;              ///< model, then system
  std::vector<Count> classes_;               ///< model, class, then system
  std::vector<Count> pieces_;
  std::vector<Count> anyArmor_;  ///< per system
};

}  // namespace lorica::shotline
