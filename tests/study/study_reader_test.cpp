#include <gtest/gtest.h>

#include <vector>

#include "full_study.h"
#include "schema_validator.h"

namespace lorica::study {
namespace {

TEST(StudyReader, ReadsEveryKey) {
  const Study study = parseStudy(fullStudy, "s");
  EXPECT_EQ(study.name, "full");
  EXPECT_EQ(study.description, "every key");
  const auto& body = std::get<InputFile>(study.human.from);
  EXPECT_EQ(body.path, "body.glb");
  EXPECT_EQ(body.sha256.substr(0, 6), "012345");
  EXPECT_EQ(body.units, base::LengthUnit::metre);
  EXPECT_EQ(body.up, 'y');
  EXPECT_EQ(study.human.parts, std::vector<std::string>{"skin"});

  ASSERT_EQ(study.organs.size(), 4U);
  const Organ& heart = study.organs[0];
  EXPECT_EQ(std::get<Builtin>(heart.mesh.from).name, "human/heart");
  EXPECT_EQ(heart.injuryClass, "essential");
  EXPECT_EQ(heart.joint, "spine_2");
  EXPECT_EQ(heart.description, "a");
  EXPECT_EQ(heart.lattice.layout, LatticeSettings::Layout::uniform);
  EXPECT_EQ(heart.lattice.cells, (std::array<int, 3>{3, 3, 3}));
  EXPECT_FALSE(heart.lattice.prune);
  EXPECT_EQ(study.organs[1].lattice.cells, (std::array<int, 3>{1, 2, 3}));
  EXPECT_EQ(study.organs[2].lattice.cellMetres, 0.0125);
  EXPECT_EQ(study.organs[3].lattice.layout, LatticeSettings::Layout::boundingBox);

  ASSERT_EQ(study.systems.size(), 2U);
  const ArmorPiece& front = study.systems[0].pieces.at(0);
  EXPECT_EQ(front.carriage, Carriage::skinned);
  EXPECT_EQ(front.nonProtecting, std::vector<std::string>{"pouch*"});
  EXPECT_EQ(front.arealDensity, 30.5);
  EXPECT_EQ(front.material, "steel");
  EXPECT_EQ(front.description, "c");
  EXPECT_EQ(study.systems[0].description, "b");

  EXPECT_EQ(std::get<ClipPose>(study.poses.at(0).what), (ClipPose{"toe_touch", 2.0}));
  const auto& turned = std::get<TurnedPose>(study.poses.at(1).what);
  EXPECT_EQ(turned.turns.at(0).joint, "elbow_L");
  EXPECT_EQ(turned.turns.at(1).degrees, geometry::Vec3d(1.0, -2.0, 3.5));
  EXPECT_EQ(turned.rootOffset, geometry::Vec3d(0.0, -0.1, 0.0));
  EXPECT_EQ(std::get<TurnedPose>(study.poses.at(2).what).turns.at(0).joint, "neck");
  EXPECT_EQ(study.runPoses, (std::vector<std::string>{"rest", "bent", "walk@1.5"}));

  const Source& source = study.sources.at(0);
  EXPECT_EQ(source.position, geometry::Vec3d(0.0, 1.0, 5.0));
  EXPECT_EQ(source.target, geometry::Vec3d(0.0, 1.2, 0.0));
  EXPECT_EQ(source.sampler, Sampler::thesis);
  EXPECT_EQ(source.shots, 1000U);
  EXPECT_EQ(study.models, (std::vector{OrganModel::staticSkin, OrganModel::dynamicThesis}));
  EXPECT_EQ(study.trials, 7U);
  EXPECT_EQ(study.seed, 18446744073709551615U);
  EXPECT_EQ(study.siteSpacing, 0.025);
  EXPECT_EQ(study.skinning, Skinning::linear);
  EXPECT_EQ(study.deformer, Deformer::lattice);

  ASSERT_EQ(study.displays.size(), 2U);
  EXPECT_EQ(study.displays[0].structure, "heart");
  EXPECT_FALSE(study.displays[0].visible);
  EXPECT_EQ(study.displays[0].colour, (std::array<std::uint8_t, 3>{0xc0, 0x28, 0x18}));
  EXPECT_EQ(study.displays[0].opacity, 0.5);
  EXPECT_EQ(study.displays[1], (Display{"body", true, std::nullopt, std::nullopt}));
}

TEST(StudyReader, TakesThePersonOfTheBuiltInHuman) {
  const auto read = [](const std::string& human) {
    return parseStudy(R"({"lorica_study": 1, "human": {"builtin": "human")" + human + "}}", "s");
  };
  EXPECT_EQ(read("").person, human::Person{});
  EXPECT_EQ(read(R"(, "sex": "female", "stature_m": 1.63, "mass_kg": 60)").person,
            (human::Person{human::Sex::female, 1.63, 60.0}));
  for (const auto& [wrong, place] : std::vector<std::pair<std::string, std::string>>{
           {R"(, "sex": "man")", "/human/sex"},
           {R"(, "stature_m": 175.5)", "/human/stature_m"},
           {R"(, "mass_kg": -1)", "/human/mass_kg"},
           {R"(, "joint_roles": {"pelvis": "hips"})", "/human/joint_roles"}}) {
    try {
      (void)read(wrong);
      FAIL() << wrong;
    } catch (const base::InputError& error) {
      EXPECT_EQ(error.place(), place);
    }
  }
}

TEST(StudyReader, GivesTheDocumentedDefaults) {
  const Study study = parseStudy(R"({"lorica_study": 1, "human": {"builtin": "human"},
                                     "organs": [{"name": "heart", "builtin": "human/heart"}],
                                     "sources": [{"name": "front", "position": [0, 1, 5]}]})",
                                 "s");
  Study expected;
  expected.human.from = Builtin{"human"};
  expected.organs.resize(1);
  expected.organs[0].name = "heart";
  expected.organs[0].mesh.from = Builtin{"human/heart"};
  expected.sources.resize(1);
  expected.sources[0].name = "front";
  expected.sources[0].position = {0.0, 1.0, 5.0};
  EXPECT_EQ(study, expected);
}

TEST(StudyReader, TakesWholeNumbersInEveryNotation) {
  EXPECT_EQ(parseStudy(fullStudyWith("/sources/0/shots", 1e5).dump(), "s").sources[0].shots, 100000U);
  EXPECT_EQ(parseStudy(fullStudyWith("/seed", 0).dump(), "s").seed, 0U);
}

struct Mistake {
  std::string at;
  Json value;
  std::string text;
  std::string place = "";  ///< where the error is told, when not there
  bool seenBySchema = true;
};

void expectTold(const Mistake& mistake) {
  const Json tree = fullStudyWith(mistake.at, mistake.value);
  const base::InputError error = errorOf(tree.dump());
  EXPECT_EQ(error.file(), "s.lorica.json");
  EXPECT_EQ(error.place(), mistake.place.empty() ? mistake.at : mistake.place);
  EXPECT_EQ(error.text(), mistake.text);
  EXPECT_EQ(std::string(error.what()).find_first_of("\n\r"), std::string::npos);
  EXPECT_EQ(test::studySchema().accepts(tree), !mistake.seenBySchema) << tree.dump();
}

TEST(StudyReader, TellsTheWrongTypeOrValueAtItsPointer) {
  const std::vector<Mistake> mistakes{
      {"/organs/3/class", "vital", R"(expected "essential" or "desirable", found "vital")"},
      {"/name", 5, "expected a name, found 5"},
      {"/name", "", "expected a name, not empty and without control characters, found \"\""},
      {"/description", Json::array(), "expected a text, found a list of 0"},
      {"/human", "plain", "expected a human with \"file\" or \"builtin\" (an object), found \"plain\""},
      {"/human/file", 1, "expected a path, found 1"},
      {"/human/units", "km", R"(expected "m", "cm", "mm" or "in", found "km")"},
      {"/human/up", "x", R"(expected "y" or "z", found "x")"},
      {"/human/sha256", "ABC", "expected 64 lower-case hexadecimal digits, found \"ABC\""},
      {"/human/parts", "skin", "expected a list of names of parts, found \"skin\""},
      {"/organs", Json::object(), "expected a list of organs, found an object"},
      {"/organs/0", nullptr, "expected an organ (an object), found null"},
      {"/organs/0/name", true, "expected a name, found true"},
      {"/organs/0/joint", 3, "expected the name of a joint, found 3"},
      {"/organs/0/lattice/layout", "octree",
       R"(expected "bounding_box", "uniform", "per_axis" or "cell_size", found "octree")"},
      {"/organs/0/lattice/cells", 0, "expected a whole number from 1 to 1000, found 0"},
      {"/organs/0/lattice/cells", 1001, "expected a whole number from 1 to 1000, found 1001"},
      {"/organs/1/lattice/cells",
       {1, 2},
       "expected a whole number or a list of three, the cells along x, y and z, found a list of 2"},
      {"/organs/1/lattice/cells/2", 2.5, "expected a whole number from 1 to 1000, found 2.5"},
      {"/organs/2/lattice/cell_mm", 0.1, "expected a size in mm above 0.1, up to 2000, found 0.1"},
      {"/organs/0/lattice/prune", 1, "expected true or false, found 1"},
      {"/armor/0/pieces/0/carriage", "worn", R"(expected "rigid" or "skinned", found "worn")"},
      {"/armor/0/pieces/0/areal_density_kg_m2", 0, "expected kg/m2 above 0, up to 10000, found 0"},
      {"/armor/0/pieces/0/material", "",
       "expected the name of a material, not empty and without control characters, found \"\""},
      {"/poses/0/seconds", -1, "expected seconds from 0 to 1000000, found -1"},
      {"/poses/1/turns", 1, "expected an object with the turned joints, found 1"},
      {"/poses/1/turns/neck", {1, 2}, "expected three numbers, degrees about x, y and z, found a list of 2"},
      {"/poses/1/root_offset/1", 1e5, "expected a number between -100000 and 100000, metres, found 100000.0"},
      {"/sources/0/position/0", "0", "expected a number between -100000 and 100000, metres, found \"0\""},
      {"/threats/0/units", "km", R"(expected "m", "cm", "mm" or "in", found "km")"},
      {"/threats/0/time_units", "h", R"(expected "s", "ms" or "us", found "h")"},
      {"/threats/0/reach_mm", 0, "expected a distance in mm from 0.001 to 1000000, found 0"},
      {"/threats/0/time_offset_ms", 2e9, "expected milliseconds of size up to 1e9, found 2000000000.0"},
      {"/threats/0/threshold", "high", "expected a number of size up to 1e30, found \"high\""},
      {"/threats/1/builtin", "bomb", "expected \"blast\", found \"bomb\""},
      {"/threats/1/tnt_kg", 0, "expected kilograms of TNT above 0, up to 1000000, found 0"},
      {"/threats/0/display/range", {1}, "expected two numbers, the lower one first, found a list of 1"},
      {"/sources/0/type", "beam", R"(expected "point", "parallel", "band", "sphere" or "list", found "beam")"},
      {"/sources/0/sampler", "grid", R"(expected "cone", "rectangle", "disk" or "thesis", found "grid")"},
      {"/sources/2/sequence", "halton", R"(expected "random", "sobol" or "grid", found "halton")"},
      {"/sources/2/width_m", 0, "expected metres above 0, up to 1000, found 0"},
      {"/sources/3/radius_m", -1, "expected metres above 0, up to 1000, found -1"},
      {"/sources/4/azimuth_deg", 361, "expected an azimuth from -360 to 360 degrees, found 361"},
      {"/sources/4/elevation_deg", -91, "expected an elevation from -90 to 90 degrees, found -91"},
      {"/sources/4/cell_mm", 0, "expected a size in mm from 0.01 to 10000, found 0"},
      {"/sources/5/elevation_deg", {5}, "expected two angles in degrees, the lower one first, found a list of 1"},
      {"/sources/5/elevation_deg/1", 95, "expected an elevation from -90 to 90 degrees, found 95"},
      {"/sources/0/shots", 0, "expected a whole number from 1 to 1000000000000, found 0"},
      {"/sources/0/shots", 1000000000001, "expected a whole number from 1 to 1000000000000, found 1000000000001"},
      {"/sources/0/shots", -5, "expected a whole number from 1 to 1000000000000, found -5"},
      {"/models/0", "static",
       R"(expected "static_joint", "static_skin", "dynamic_thesis" or "dynamic", found "static")"},
      {"/stop/half_width", 0, "expected half the width of an interval above 0, up to 0.5, found 0"},
      {"/stop/max_trials", 0, "expected a whole number from 1 to 100000, found 0"},
      {"/stop/structures", Json::array(),
       "names no organ; name one whose interval is to be narrow, or remove \"stop\""},
      {"/overlap/policy", "first", R"(expected "all_claim", "outermost" or "priority", found "first")"},
      {"/overlap/policy", "outermost", "belongs to the policy \"priority\"; remove it here", "/overlap/order"},
      {"/analyses/compare", 1, "expected true or false, found 1"},
      {"/analyses/directions/step_deg", 91, "expected a whole number from 1 to 90, found 91"},
      {"/analyses/motion/frames_per_second", 0, "expected frames per second above 0, up to 1000, found 0"},
      {"/analyses/gaps/open_share", -0.1, "expected a share of shots from 0 to 0.95, found -0.1"},
      {"/analyses/gaps/min_shots", 0, "expected a whole number from 1 to 1000000, found 0"},
      {"/analyses/gaps/radius_mm", -1, "expected a radius in mm from 0 to 1000, found -1"},
      {"/analyses/gaps/structures", Json::array(), "names no structure; name an organ or \"body\", or remove \"gaps\""},
      {"/analyses/anatomy/draws", 0, "expected a whole number from 2 to 100000, found 0"},
      {"/analyses/anatomy/scale", -1, "expected a factor from 0 to 10, found -1"},
      {"/analyses/anatomy/sd_mm/heart", {1, -2, 3}, "standard deviations are from 0 to 500 mm"},
      {"/trials", 100001, "expected a whole number from 1 to 100000, found 100001"},
      {"/seed", 1.5, "expected a whole number from 0 to 18446744073709551615, found 1.5"},
      {"/display/0/colour", "red", "expected a colour such as \"#c02818\", found \"red\""},
      {"/display/0/opacity", 1.5, "expected an opacity from 0 to 1, found 1.5"},
      {"/display/0/visible", "no", "expected true or false, found \"no\""},
      {"/site_spacing_mm", 4.9, "expected a spacing in mm from 5 to 500, found 4.9"},
      {"/site_spacing_mm", 501, "expected a spacing in mm from 5 to 500, found 501"},
      {"/deformer", "springs", R"(expected "soft_body" or "lattice", found "springs")"},
      {"/skinning", "smooth", R"(expected "rotation_centres" or "linear", found "smooth")"},
  };
  for (const Mistake& mistake : mistakes) {
    expectTold(mistake);
  }
}

TEST(StudyReader, TellsWhatIsMissingOrDoesNotGoTogether) {
  const std::vector<Mistake> mistakes{
      {"/organs/2", {{"builtin", "human/spleen"}}, "expected a name, found nothing", "/organs/2/name"},
      {"/organs/2", {{"name", "x"}}, "expected \"file\" (a path) or \"builtin\" (a name), found neither"},
      {"/human/builtin", "plain", "expected either \"file\" or \"builtin\", found both", "/human"},
      {"/human/sex", "male", "belongs to the \"builtin\" human; remove it here"},
      {"/human/joint_roles/pelvis", 3, "expected the name of a joint, or a list of them, found 3"},
      {"/organs/0/up", "y", "belongs to a \"file\"; remove it here"},
      {"/organs/0/lattice/cell_mm", 40, "belongs to the layout \"cell_size\"; change the layout or remove it"},
      {"/organs/2/lattice/cells", 2,
       "belongs to the layouts \"uniform\" and \"per_axis\"; change the layout or remove it"},
      {"/organs/2/lattice",
       {{"layout", "uniform"}},
       "expected a whole number or a list of three, the cells along x, y and z, found nothing",
       "/organs/2/lattice/cells"},
      {"/poses/0/turns", Json::object(), "expected either \"clip\" or \"turns\", found both", "/poses/0"},
      {"/poses/0", {{"name", "a"}}, "expected \"clip\" (a name) or \"turns\" (of joints), found neither"},
      {"/poses/0/root_offset", {0, 0, 1}, "belongs to \"turns\"; remove it here"},
      {"/poses/1/seconds", 1, "belongs to \"clip\"; remove it here"},
      {"/poses/2/turns/0",
       {{"joint", "neck"}},
       "expected three numbers, degrees about x, y and z, found nothing",
       "/poses/2/turns/0/degrees"},
      {"/sources/1", {{"name", "x"}}, "expected three numbers, metres, found nothing", "/sources/1/position"},
      {"/sources/1/target_structure", "",
       "expected the name of an organ or a piece, not empty and without control characters, found \"\""},
      {"/sources/2/target",
       {0, 0, 0},
       "expected either \"target\" or \"target_structure\", found both",
       "/sources/2/target_structure"},
      {"/sources/2/radius_m", 1, "belongs to the sampler \"disk\"; remove it here"},
      {"/sources/1/height_m", 1, "belongs to the sampler \"rectangle\"; remove it here"},
      {"/sources/1/azimuth_deg", 1, "belongs to the types \"parallel\" and \"band\"; remove it here"},
      {"/sources/4/position", {0, 0, 1}, "belongs to the type \"point\"; remove it here"},
      {"/sources/4/shots", 10,
       "belongs to sources without a grid: the size of the cells decides their number; remove it here"},
      {"/sources/5/sequence", "grid", "a grid belongs to the type \"parallel\"; choose \"random\" or \"sobol\""},
      {"/sources/5/cell_mm", 5, "belongs to the sequence \"grid\"; remove it here"},
      {"/sources/5/elevation_deg",
       {15, 15},
       "from 15 to 15 degrees is empty; the second angle must be the larger",
       "",
       false},
      {"/analyses/directions/step_deg", 50,
       "steps of 50 degrees do not divide 180; choose 10, 15, 20, 30 or another that does", "", false},
      {"/analyses/motion", Json::object(), "expected the name of a clip, found nothing", "/analyses/motion/clip"},
      {"/sources/5/azimuth_deg", {-180, 181}, "from -180 to 181 degrees is more than a full turn", "", false},
      {"/sources/0/sequence", "sobol", "the thesis' sampler takes random numbers; remove it or choose another sampler"},
      {"/sources/7/sequence", "sobol", "shots of a list are as the file has them; remove it"},
      {"/sources/7/shots", 10, "belongs to sources that make their own shots; remove it here"},
      {"/threats/0/builtin", "blast", R"(expected either "file" or "builtin", found both)", "/threats/0"},
      {"/threats/0", {{"name", "x"}}, R"(expected "file" (a path) or "builtin" (a name), found neither)"},
      {"/threats/0/tnt_kg", 1, "belongs to the builtin \"blast\"; remove it here"},
      {"/threats/1/units", "m", "belongs to a \"file\"; remove it here"},
      {"/threats/0/display/range", {2, 2}, "is empty; the second number must be the larger", "", false},
      {"/sources/6/file", "shots.csv", "belongs to the type \"list\"; remove it here"},
      {"/sources/6", {{"name", "x"}, {"type", "list"}}, "expected a path, found nothing", "/sources/6/file"},
  };
  for (const Mistake& mistake : mistakes) {
    expectTold(mistake);
  }
}

TEST(StudyReader, TellsNamesThatAreTakenReservedOrMisleading) {
  const std::string row = " is kept for a row of the results; choose another";
  const std::vector<Mistake> mistakes{
      {"/organs/1/name", "heart", "the name \"heart\" is taken by /organs/0/name; choose another", "", false},
      {"/armor/0/pieces/1/name", "front", "the name \"front\" is taken by /armor/0/pieces/0/name; choose another", "",
       false},
      {"/armor/1/pieces/0/name", "front", "the name \"front\" is taken by /armor/0/pieces/0/name; choose another", "",
       false},
      {"/armor/1/pieces/0/name", "liver", "the name \"liver\" is taken by /organs/1/name; choose another", "", false},
      {"/armor/1/name", "vest", "the name \"vest\" is taken by /armor/0/name; choose another", "", false},
      {"/poses/1/name", "bent", "the name \"bent\" is taken by /poses/0/name; choose another", "", false},
      {"/sources/1/name", "front", "the name \"front\" is taken by /sources/0/name; choose another", "", false},
      {"/poses/2/turns/1",
       {{"joint", "neck"}, {"degrees", {0, 0, 1}}},
       "the name \"neck\" is taken by /poses/2/turns/0/joint; choose another",
       "/poses/2/turns/1/joint",
       false},
      {"/threats/1/name", "gauge", "the name \"gauge\" is taken by /threats/0/name; choose another", "", false},
      {"/run_poses/1", "rest", "the name \"rest\" is taken by /run_poses/0; choose another"},
      {"/models/1", "static_skin", "the name \"static_skin\" is taken by /models/0; choose another"},
      {"/human/parts", {"a", "a"}, "the name \"a\" is taken by /human/parts/0; choose another", "/human/parts/1"},
      {"/organs/0/name", "body", "the name \"body\"" + row},
      {"/organs/0/name", "miss", "the name \"miss\"" + row},
      {"/armor/0/pieces/0/name", "armor", "the name \"armor\"" + row},
      {"/armor/0/pieces/0/name", "organs", "the name \"organs\"" + row},
      {"/armor/0/name", "unarmored",
       "the name \"unarmored\" is kept for the body without armor, which is always computed; choose another"},
      {"/poses/0/name", "rest", "the name \"rest\" is kept for the bind pose, which always exists; choose another"},
      {"/poses/0/name", "toe_touch@3", "\"toe_touch@3\" reads as a clip at a time, and the pose is another; rename it",
       "", false},
      {"/run_poses/1", "bend", R"(expected "rest", a pose of this study or CLIP@SECONDS, found "bend")", "", false},
      {"/run_poses/2", "walk@", R"(expected "rest", a pose of this study or CLIP@SECONDS, found "walk@")", "", false},
      {"/organs/0/name", "a\nb", "expected a name, not empty and without control characters, found \"a\\u000ab\""},
      {"/poses/1/turns/",
       {0, 0, 0},
       "expected the name of a joint, not empty and without control characters, found \"\""},
  };
  for (const Mistake& mistake : mistakes) {
    expectTold(mistake);
  }
}

TEST(StudyReader, AllowsAPoseNamedLikeTheClipAtATimeThatItIs) {
  const Json tree = fullStudyWith("/poses/0", {{"name", "toe_touch@2.0"}, {"clip", "toe_touch"}, {"seconds", 2}});
  Json named = tree;
  named["run_poses"] = Json::array();
  EXPECT_NO_THROW(parseStudy(named.dump(), "s"));
}

TEST(StudyReader, LeadsFromAnUnknownKeyToTheNearestKnownOnes) {
  const std::vector<Mistake> mistakes{
      {"/sources/0/shot", 5, "unknown key \"shot\"; did you mean \"shots\"?"},
      {"/organ", 5, "unknown key \"organ\"; did you mean \"organs\"?"},
      {"/human/unit", "m", "unknown key \"unit\"; did you mean \"units\"?"},
      {"/organs/0/lattice/cel", 5, "unknown key \"cel\"; did you mean \"cells\"?"},
      {"/armor/1/colour", 5, R"(unknown key "colour"; known here are "name", "description", "pieces")"},
      {"/poses/2/turns/0/x", 5, R"(unknown key "x"; known here are "joint", "degrees")"},
      {"/armor/0/pieces/1/a~1b~0c", 5,
       "unknown key \"a/b~c\"; known here are \"name\", \"description\", \"file\", "
       "\"sha256\", \"units\", \"up\", \"builtin\", \"parts\", \"carriage\", \"non_protecting\", "
       "\"areal_density_kg_m2\", \"material\""},
  };
  for (const Mistake& mistake : mistakes) {
    expectTold(mistake);
  }
}

TEST(StudyReader, KeepsErrorsAboutHugeOrStrangeTextShort) {
  const std::string huge(1000000, 'k');
  EXPECT_LT(std::string(errorOf(fullStudyWith("/" + huge, 1).dump()).what()).size(), 600U);
  EXPECT_LT(std::string(errorOf(fullStudyWith("/organs/0/class", huge).dump()).what()).size(), 200U);
  EXPECT_EQ(std::string(errorOf(fullStudyWith("/a\nb", 1).dump()).what()).find('\n'), std::string::npos);
}

TEST(StudyReader, SaysThatATextIsNoStudy) {
  EXPECT_STREQ(errorOf("[]").what(), "s.lorica.json: expected a study (an object), found a list of 0");
  EXPECT_STREQ(errorOf("{\"asset\": {}}").what(),
               "s.lorica.json: /lorica_study: expected 1, the version of the study format, found nothing; is this a "
               "study?");
  EXPECT_EQ(errorOf("{\"lorica_study\": 1}").place(), "/human");
}

TEST(ClipPoseText, IsAClipAnAtAndSeconds) {
  EXPECT_EQ(clipPoseNamed("toe_touch@2"), (ClipPose{"toe_touch", 2.0}));
  EXPECT_EQ(clipPoseNamed("a@b@0.25"), (ClipPose{"a@b", 0.25}));
  for (const char* text : {"", "walk", "@2", "walk@", "walk@-1", "walk@1s", "walk@inf", "walk@nan", "walk@ 1"}) {
    EXPECT_FALSE(clipPoseNamed(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace lorica::study
