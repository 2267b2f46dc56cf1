#pragma once

/// \file
/// The report of a run: what an analyst hands in, as PDF. Made from the tables and pictures in the run's folder, so
/// that it says what they say. Needs a QGuiApplication (any platform, `offscreen` too), no display and no OpenGL.

#include <QByteArray>
#include <QImage>
#include <filesystem>
#include <string>
#include <vector>

#include "lorica/analysis/run.h"
#include "lorica/analysis/run_tables.h"

namespace lorica::report {

/// A pose under one armor system, from the front, from the person's left and from the back.
struct PosePictures {
  std::string pose;
  std::string system;  ///< may be "unarmored"
  QImage front;
  QImage side;
  QImage back;
};

struct LegendEntry {
  std::string structure;
  std::string system;  ///< of armor; empty else
  QRgb colour = 0;
};

/// All at one scale.
struct PictureSet {
  std::string model;  ///< of the organs
  double metresPerPixel = 0.0;
  std::vector<PosePictures> poses;
  std::vector<LegendEntry> legend;
};

/// Draws the poses of a run, the first 24 of them, under the first armor system, and the first pose under each of the
/// others.
/// \throw base::Cancelled. Cost: about a second for three poses
PictureSet drawPictures(const analysis::LoadedStudy& study, const analysis::RunResult& result, base::Threads threads,
                        const base::Progress& progress = {});

/// The pictures that writeRunReport() left in the folder of a run; empty when there are none or they are of another
/// study.
/// \throw base::InputError when they are damaged
PictureSet readPictures(const std::filesystem::path& folder, const study::RunFacts& facts);

/// The report as the bytes of a PDF file. Holds no time: the same tables and pictures give the same bytes, with the
/// same Qt and fonts, while Qt's hash seed is fixed (QHashSeed).
/// \throw base::Cancelled
QByteArray reportPdf(const analysis::RunTables& run, const PictureSet& pictures, const base::Progress& progress = {});

/// Draws the pictures of a run whose tables are in a folder, and its report: PNG files with pictures.csv and legend.csv
/// in the folder's `pictures`, the PDF at `file`; all or none.
/// \throw base::InputError as analysis::readRunTables and when files cannot be written; base::Cancelled
void writeRunReport(const analysis::LoadedStudy& study, const analysis::RunResult& result,
                    const std::filesystem::path& folder, const std::filesystem::path& file, base::Threads threads,
                    const base::Progress& progress = {});

/// reportPdf() of a run's folder into a file, all or nothing.
/// \throw base::InputError as analysis::readRunTables and when the file cannot be written; base::Cancelled
void writeReport(const std::filesystem::path& folder, const std::filesystem::path& file,
                 const base::Progress& progress = {});

}  // namespace lorica::report
