#include "finish.h"

#include <fmt/format.h>

#include <exception>

#include "lorica/base/parallel.h"
#include "lorica/geometry/transform.h"
#include "names.h"
#include "part_builder.h"
#include "units_guess.h"

namespace lorica::io {

using base::LengthUnit;
using geometry::Box3d;
using geometry::Quatd;
using geometry::Vec3d;
using human::ChannelPath;

namespace {

constexpr double largestPlausible = 10.0;  // metres

Box3d boxOf(const RawModel& raw) {
  Box3d box;
  for (const RawPart& part : raw.parts) {
    for (const Vec3d& position : part.positions) {
      box.extend(position);
    }
  }
  return box;
}

const char* longName(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::metre:
      return "metres";
    case LengthUnit::centimetre:
      return "centimetres";
    case LengthUnit::millimetre:
      return "millimetres";
    case LengthUnit::inch:
      return "inches";
  }
  return "";
}

void chooseFrame(Model& model, const Box3d& box, const FormatFrame& frame, const ImportOptions& options,
                 Reading& reading) {
  model.unitsGuessed = !options.units && !frame.units;
  model.units = options.units ? *options.units : frame.units.value_or(guessUnits(box));
  model.upGuessed = !options.up && !frame.up;
  model.up = options.up ? *options.up : frame.up.value_or(guessUp(box));
  const double extent = box.sizes().maxCoeff();
  if (model.unitsGuessed) {
    reading.note("", fmt::format("the format has no units; {} are guessed from the largest extent, {:.4g} (--units "
                                 "decides)",
                                 longName(model.units), extent));
  }
  if (model.upGuessed) {
    reading.note("", fmt::format("the format has no up axis; {} is guessed from the shape (--up decides)",
                                 model.up == UpAxis::y ? "y" : "z"));
  }
  if (!options.units && extent * base::metresPer(model.units) > largestPlausible) {
    reading.warn("", fmt::format("is {:.4g} m large, more than a person; if its numbers are no {}, give --units",
                                 extent * base::metresPer(model.units), longName(model.units)));
  }
}

/// A rotation of the whole scene turns what has no parent; everything below follows.
void turnRoots(RawModel& raw, const Quatd& turn) {
  for (human::Joint& joint : raw.joints) {
    if (!joint.parent) {
      joint.rest.translation = turn * joint.rest.translation;
      joint.rest.rotation = (turn * joint.rest.rotation).normalized();
    }
  }
  for (human::Clip& clip : raw.clips) {
    for (human::Channel& channel : clip.channels) {
      if (raw.joints[channel.joint.value].parent) {
        continue;
      }
      for (Eigen::Vector4d& value : channel.values) {
        if (channel.path == ChannelPath::translation) {
          value.head<3>() = turn * Vec3d(value.head<3>());
        } else if (channel.path == ChannelPath::rotation) {
          value = (turn * Quatd(value)).coeffs();
        }
      }
    }
  }
}

/// A change of units scales every length; joints keep their own scale.
void scaleLengths(RawModel& raw, double metres) {
  for (human::Joint& joint : raw.joints) {
    joint.rest.translation *= metres;
  }
  for (human::Clip& clip : raw.clips) {
    for (human::Channel& channel : clip.channels) {
      if (channel.path == ChannelPath::translation) {
        for (Eigen::Vector4d& value : channel.values) {
          value *= metres;
        }
      }
    }
  }
}

void placeInScene(RawModel& raw, double metres, UpAxis up) {
  if (metres != 1.0) {
    scaleLengths(raw, metres);
    for (RawPart& part : raw.parts) {
      for (Vec3d& position : part.positions) {
        position *= metres;
      }
    }
  }
  if (up == UpAxis::z) {
    const geometry::Mat3d turn = geometry::zUpToYUp();
    turnRoots(raw, Quatd(turn));
    for (RawPart& part : raw.parts) {
      for (Vec3d& position : part.positions) {
        position = turn * position;
      }
    }
  }
}

/// All parts at once; what is reported does not depend on which of them was ready first.
std::vector<Part> buildParts(std::vector<RawPart>& raw, Reading& reading) {
  struct Work {
    std::string name;
    Reading reading;
    std::optional<Part> part;
    std::exception_ptr failure;
  };
  std::vector<Work> work;
  UniqueNames names;
  for (std::size_t p = 0; p < raw.size(); ++p) {
    work.push_back({names.take(raw[p].name, fmt::format("part_{}", p)), reading.branch(), {}, {}});
  }
  base::parallelFor(raw.size(), 1, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      try {
        work[p].part = buildPart(std::move(raw[p]), work[p].name, work[p].reading);
      } catch (const base::Error&) {
        work[p].failure = std::current_exception();
      }
    }
  });
  std::vector<Part> parts;
  for (Work& done : work) {
    if (done.failure) {
      std::rethrow_exception(done.failure);
    }
    reading.join(std::move(done.reading));
    if (done.part) {
      parts.push_back(std::move(*done.part));
    }
  }
  return parts;
}

}  // namespace

Model finish(RawModel raw, const FormatFrame& frame, const ImportOptions& options, Reading& reading) {
  Model model;
  const Box3d box = boxOf(raw);
  if (box.isEmpty()) {
    reading.fail("", "holds no triangles; a surface mesh was expected");
  }
  chooseFrame(model, box, frame, options, reading);
  placeInScene(raw, base::metresPer(model.units), model.up);

  model.parts = buildParts(raw.parts, reading);
  if (model.parts.empty()) {
    reading.fail("", "holds no triangles with area; a surface mesh was expected");
  }
  if (!raw.joints.empty()) {
    UniqueNames jointNames;
    for (std::size_t j = 0; j < raw.joints.size(); ++j) {
      raw.joints[j].name = jointNames.take(raw.joints[j].name, fmt::format("joint_{}", j));
    }
    model.skeleton.emplace(std::move(raw.joints));
  }
  UniqueNames clipNames;
  for (std::size_t c = 0; c < raw.clips.size(); ++c) {
    raw.clips[c].name = clipNames.take(raw.clips[c].name, fmt::format("clip_{}", c));
  }
  model.clips = std::move(raw.clips);
  model.issues = reading.takeIssues();
  return model;
}

}  // namespace lorica::io
