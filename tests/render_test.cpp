#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include <epoxy/egl.h>
#include <gmock/gmock.h>

#include "scenes/play.hpp"
#include "scenes/view/egl_context.hpp"
#include "scenes/view/movie.hpp"
#include "scenes/view/studio.hpp"
#include "tests/refusals.hpp"

namespace seam {
namespace {

using test::BadCall;
using test::Outcome;
using test::run;
using testing::HasSubstr;

// On another driver than ours a pixel on an edge may differ by much, the mean of a block of pixels by little.
constexpr int block = 8;                  // [pixels]
constexpr double block_tolerance = 20.0;  // of 255
constexpr double mean_tolerance = 3.0;

class Render : public testing::Test {
 protected:
  void SetUp() override {
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "drivers run threads that the sanitizer does not see";
#endif
    try {
      context_.emplace("software");
    } catch (const Error& error) {
      GTEST_SKIP() << "NOTHING IS DRAWN HERE: " << error.what();
    }
  }

  std::optional<EglContext> context_;
};

EGLDisplay display_of(const EglDevice& device) {
  return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device.handle, nullptr);
}

TEST_F(Render, DrawsOnTheListedDeviceThatIsSoftware) {
  std::vector<EglDevice> software;
  for (const EglDevice& device : egl_devices()) {
    const char* extensions = eglQueryDeviceStringEXT(device.handle, EGL_EXTENSIONS);
    ASSERT_NE(extensions, nullptr);  // a handle that EGL does not know has none
    EXPECT_EQ(std::string(extensions).find("EGL_MESA_device_software") != std::string::npos,
              device.software);
    if (device.software) software.push_back(device);
  }
  ASSERT_EQ(software.size(), 1);
  EXPECT_EQ(eglGetCurrentDisplay(), display_of(software[0]));
  EXPECT_THAT(context_->renderer(), HasSubstr("llvmpipe"));
}

// By itself it takes a graphics card if there is one.
TEST_F(Render, PrefersAGraphicsCardUnlessToldOtherwise) {
  context_.reset();
  std::optional<EglContext> card;
  try {
    card.emplace("gpu");
  } catch (const Error&) {
    context_.emplace("auto");
    EXPECT_THAT(context_->renderer(), HasSubstr("llvmpipe"));
    return;
  }
  const std::string name = card->renderer();
  EXPECT_THAT(name, testing::Not(HasSubstr("llvmpipe")));
  card.reset();
  context_.emplace("auto");
  EXPECT_EQ(context_->renderer(), name);
}

Replay empty_scene(const Camera& camera) {
  Replay replay;
  replay.method = "none";
  replay.primitives = {"rest"};
  replay.running = {-1, -1};
  replay.tool = Replay::Track::Zero(2, 3);
  replay.camera = camera;
  return replay;
}

void add_part(Replay& replay, const Replay::Part& part, const Eigen::Vector3d& at) {
  replay.parts.push_back(part);
  replay.poses.conservativeResize(2, 7 * static_cast<Eigen::Index>(replay.parts.size()));
  for (const Eigen::Index frame : {0, 1})
    replay.set_pose(frame, replay.parts.size() - 1, Eigen::Isometry3d(Eigen::Translation3d(at)));
}

Geometry ball(double radius, const Eigen::Vector4d& colour) {
  Geometry shape;
  shape.type = Geometry::Type::sphere;
  shape.size.setConstant(radius);
  shape.colour = colour;
  shape.has_colour = true;
  return shape;
}

Image drawn(const Replay& replay, int width, int height) {
  const Stage stage(replay);
  return Renderer(width, height).draw(stage.at(0.0, 1e-4), replay.camera, stage.around());
}

bool is_red(const Image::Colour& c) {
  return c[0] > 2 * c[1] && c[0] > 2 * c[2];
}
bool is_blue(const Image::Colour& c) {
  return c[2] > 1.4 * c[0] && c[2] > 1.15 * c[1];
}

template <typename Kind>
Eigen::Vector3d centroid(const Image& image, Kind kind) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // x, y, number
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (kind(image.at(x, y))) sum += Eigen::Vector3d(x + 0.5, y + 0.5, 1.0);
  return {sum.x() / sum.z(), sum.y() / sum.z(), sum.z()};
}

// A camera that looks along -x sees y to the right and z up; 35 degrees over the height.
TEST_F(Render, PutsAPointWhereGeometrySays) {
  const Camera camera{{3.0, 0.0, 1.0}, {0.0, 0.0, 1.0}};
  const Eigen::Vector3d at(0.5, 0.4, 1.2);
  Replay replay = empty_scene(camera);
  add_part(replay, {"ball", {ball(0.04, {0.9, 0.1, 0.1, 1.0})}, {}}, at);
  const Image image = drawn(replay, 640, 480);
  const double pixels_per_metre = 240.0 / std::tan(17.5 * M_PI / 180.0) / 2.5;
  const Eigen::Vector2d expected(320.0 + 0.4 * pixels_per_metre, 240.0 - 0.2 * pixels_per_metre);
  const Eigen::Vector3d found = centroid(image, is_red);
  EXPECT_LT((found.head<2>() - expected).norm(), 1.0);
  EXPECT_NEAR(found.z(), M_PI * std::pow(0.04 * pixels_per_metre, 2), 0.05 * found.z());
  const Eigen::Vector3d projected = Lens(camera, 640, 480).project(at);
  EXPECT_LT((projected.head<2>() - expected).norm(), 1e-9);
  EXPECT_NEAR(projected.z(), 2.5, 1e-12);
}

// The same from anywhere, against the camera's own axes.
TEST_F(Render, PutsItThereFromAnywhere) {
  const Eigen::Vector3d at(0.3, -0.2, 0.6);
  for (const Eigen::Vector3d& from :
       {Eigen::Vector3d(1.5, -1.5, 1.2), Eigen::Vector3d(-2, 0.4, 0.3)}) {
    const Camera camera{from, {0.2, 0.0, 0.5}};
    Replay replay = empty_scene(camera);
    add_part(replay, {"ball", {ball(0.03, {0.9, 0.1, 0.1, 1.0})}, {}}, at);
    const Eigen::Vector3d ahead = (camera.at - from).normalized();
    const Eigen::Vector3d right = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
    const Eigen::Vector3d seen = at - from;
    const double scale = 200.0 / std::tan(17.5 * M_PI / 180.0) / seen.dot(ahead);
    const Eigen::Vector2d expected(300.0 + scale * seen.dot(right),
                                   200.0 - scale * seen.dot(right.cross(ahead)));
    EXPECT_LT((centroid(drawn(replay, 600, 400), is_red).head<2>() - expected).norm(), 1.0);
  }
}

TEST_F(Render, HidesWhatIsBehind) {
  Replay replay = empty_scene({{2.0, 0.0, 0.5}, {0.0, 0.0, 0.5}});
  add_part(replay, {"far", {ball(0.05, {0.9, 0.1, 0.1, 1.0})}, {}}, {0.0, 0.0, 0.5});
  EXPECT_GT(centroid(drawn(replay, 200, 200), is_red).z(), 80.0);
  add_part(replay, {"near", {ball(0.06, {0.1, 0.2, 0.9, 1.0})}, {}}, {0.5, 0.0, 0.5});
  EXPECT_EQ(centroid(drawn(replay, 200, 200), is_red).z(), 0.0);
}

// Light comes from above and from the right of a camera that looks along y: shadows fall to the left.
TEST_F(Render, CastsASoftShadowOnTheFloor) {
  Replay replay = empty_scene({{0.0, -2.0, 1.5}, {0.0, 0.0, 0.0}});
  add_part(replay, {"ball", {ball(0.1, {0.9, 0.1, 0.1, 1.0})}, {}}, {0.0, 0.0, 0.4});
  const Image image = drawn(replay, 400, 400);
  const auto brightness = [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d at = Lens(replay.camera, 400, 400).project(point);
    return static_cast<int>(image.at(static_cast<int>(at.x()), static_cast<int>(at.y()))[1]);
  };
  const Eigen::Vector2d middle =
      -0.4 * Eigen::Vector2d(0.35, -0.55);  // light along (0.35, -0.55, 1)
  const auto beside = [&](double x) {
    return brightness({middle.x() + x, middle.y() + 0.03, 0.0});
  };
  EXPECT_LT(beside(0.0), beside(0.2) - 40);
  EXPECT_GT(beside(0.1), beside(0.0) + 10);
  EXPECT_LT(beside(0.1), beside(0.2) - 10);
}

Replay glass_with_a_wave(double wave_y) {
  Replay replay = empty_scene({{0.6, 0.0, 0.15}, {0.0, 0.0, 0.13}});
  add_part(replay, {"glass", {}, VesselSettings{0.035, 0.08, 0.002, 0.1}}, {0.0, 0.0, 0.1});
  Replay::Track waves(2, 2);
  waves << 0.0F, static_cast<float>(wave_y), 0.0F, static_cast<float>(wave_y);
  replay.liquid = {0, 0.035, 0.07, 0.010, waves, Replay::Track::Zero(2, 1)};
  return replay;
}

// Seen from a little below the surface, the water's edge is that at the near wall.
TEST_F(Render, TiltsTheLiquidAsTheWaveSays) {
  constexpr int size = 600;
  const double wave = 0.008;
  const double R = 0.035;
  const Replay replay = glass_with_a_wave(wave);
  const Image image = drawn(replay, size, size);
  const Lens lens(replay.camera, size, size);
  const auto surface_at = [&](double y) {
    const Eigen::Vector3d foot = lens.project({std::sqrt(R * R - y * y), y, 0.13});
    for (int row = 0; row < size; ++row)
      if (is_blue(image.at(static_cast<int>(foot.x()), row))) return row;
    return -1;
  };
  for (const double y : {-0.022, 0.0, 0.022}) {
    const Eigen::Vector3d expected =
        lens.project({std::sqrt(R * R - y * y), y, 0.17 + wave * y / R});
    EXPECT_NEAR(surface_at(y), expected.y(), 3.0) << y;
  }
  EXPECT_EQ(centroid(image, is_red).z(), 0.0);
}

TEST_F(Render, ShowsWhatIsAboveTheRimInRed) {
  const auto red = [](double wave) {
    Replay replay = glass_with_a_wave(wave);
    replay.camera.from.z() = 0.5;
    return centroid(drawn(replay, 400, 400), is_red).z();
  };
  EXPECT_EQ(red(0.0095), 0.0);
  EXPECT_GT(red(0.014), 40.0);
}

Replay carried(Join method) {
  const Scene scene = Scene::read(SEAM_SCENES "/carrying.yaml");
  Replay replay;
  play(scene, method, scene.dt, &replay);
  return replay;
}

StudioSettings small() {
  StudioSettings settings;
  settings.width = 480;
  settings.height = 240;
  settings.inset = true;
  return settings;
}

struct Difference {
  double block = 0.0, mean = 0.0;  // largest of a block's mean, mean over all
};

Difference difference(const Image& a, const Image& b) {
  Difference result;
  for (int top = 0; top < a.height; top += block)
    for (int left = 0; left < a.width; left += block) {
      Eigen::Array3d sum = Eigen::Array3d::Zero();
      for (int y = top; y < top + block; ++y)
        for (int x = left; x < left + block; ++x)
          for (int i = 0; i < 3; ++i)
            sum(i) +=
                a.at(x, y)[static_cast<std::size_t>(i)] - b.at(x, y)[static_cast<std::size_t>(i)];
      const double largest = sum.abs().maxCoeff() / (block * block);
      result.block = std::max(result.block, largest);
      result.mean += largest * block * block / (a.width * a.height);
    }
  return result;
}

// SEAM_RENEW=1 in the environment makes the reference anew: look at it before committing.
TEST_F(Render, LooksAsItDid) {
  const std::string reference = SEAM_TEST_DATA "/carrying.png";
  const Studio studio({carried(Join::dmp2), carried(Join::dmp3)}, small());
  if (std::getenv("SEAM_RENEW")) studio.at(1.03).write_png(reference);
  const Image expected = Image::read_png(reference);
  const Difference same = difference(studio.at(1.03), expected);
  EXPECT_LT(same.block, block_tolerance);
  EXPECT_LT(same.mean, mean_tolerance);
  const Difference later = difference(studio.at(1.13), expected);
  EXPECT_GT(later.block, block_tolerance);
}

TEST_F(Render, GivesTheSamePictureTwice) {
  const Replay replay = carried(Join::dmp3);
  EXPECT_TRUE(Studio({replay}, small()).at(0.5).rgb == Studio({replay}, small()).at(0.5).rgb);
}

// The mark of the join stands where the recorded tool was.
TEST_F(Render, MarksTheJoinWhereTheToolWas) {
  const Replay replay = carried(Join::dmp3);
  const Stage stage(replay);
  const Camera camera{{0.9, -0.9, 0.5}, {0.5, -0.1, 0.15}};
  const Image image =
      Renderer(600, 450).draw(stage.at(stage.duration(), 0.004), camera, stage.around());
  const auto frame = static_cast<Eigen::Index>(std::lround(replay.joins[1] * replay.frame_rate));
  const Eigen::Vector3d mark =
      Lens(camera, 600, 450).project(replay.tool.row(frame).transpose().cast<double>());
  const Image::Colour colour = image.at(static_cast<int>(mark.x()), static_cast<int>(mark.y()));
  for (const int part : colour) EXPECT_LT(part, 70);
}

TEST(Drops, HoldWhatIsSpilledAndComeToRestOnTheFloor) {
  const Replay replay = carried(Join::dmp2);
  double volume = 0.0;
  for (const Drop& drop : drops(replay)) {
    volume += 4.0 / 3.0 * M_PI * std::pow(drop.radius, 3);
    EXPECT_LT(std::abs(drop.position(100.0).z()), drop.radius);
    EXPECT_GT(drop.lands, drop.leaves);
  }
  const double spilled = replay.liquid->spilled(replay.frames() - 1, 0);
  EXPECT_GT(spilled, 0.004);
  EXPECT_NEAR(volume, spilled * M_PI * 0.035 * 0.035 * 0.07, 1e-9);
  EXPECT_TRUE(drops(carried(Join::dmp3)).empty());
}

// As a user calls it.
class RenderProgram : public Render {
 protected:
  void SetUp() override {
    Render::SetUp();
    for (const char* replay : {"dmp2.replay.json", "dmp3.replay.json"})
      std::filesystem::create_symlink(SEAM_RESULTS "/bench/carrying/" + std::string(replay),
                                      folder_.path(replay));
  }

  Outcome render(const std::string& arguments, const std::string& environment = "") const {
    return run("render " + folder_.path("dmp2") + " " + arguments, environment);
  }
  std::vector<std::string> pictures() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path("")))
      if (entry.path().extension() != ".json") names.push_back(entry.path().filename());
    return names;
  }

  TempFolder folder_;
};

TEST_F(RenderProgram, WritesAPictureOfTheSizeAsked) {
  const Outcome outcome = render("--at 1 --size 200x100 -o " + folder_.path("a.png"));
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const Image image = Image::read_png(folder_.path("a.png"));
  EXPECT_EQ(image.width, 200);
  EXPECT_EQ(image.height, 100);
}

// A movie's frame, taken out again by ffmpeg, is the still picture of that time.
TEST_F(RenderProgram, WritesMoviesThatShowWhatStillsShow) {
  const std::string still = folder_.path("still.png");
  const std::string size = " --size 240x160 --compare dmp2,dmp3";
  ASSERT_EQ(render("--at 1.05 -o " + still + size).status, 0);
  for (const char* name : {"a.mp4", "a.webm"}) {
    const std::string movie = folder_.path(name);
    const Outcome outcome = render("--from 1 --to 1.1 --speed 0.5 --fps 20 -o " + movie + size);
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const std::string last = folder_.path("last.png");
    ASSERT_EQ(std::system(
                  ("ffmpeg -v error -y -i " + movie + " -vf select='eq(n\\,2)' -frames:v 1 " + last)
                      .c_str()),
              0);
    EXPECT_LT(difference(Image::read_png(last), Image::read_png(still)).mean, 4.0) << name;
  }
  ASSERT_EQ(render("--from 1 --to 1.1 --fps 20 -o " + folder_.path("a.webp") + size).status, 0);
  EXPECT_EQ(test::read_file(folder_.path("a.webp")).substr(8, 4), "WEBP");
}

struct BadRender {
  const char* name;
  const char* arguments;  // @ stands for the folder
  const char* environment;
  const char* message;
};

class RenderRefuses : public RenderProgram, public testing::WithParamInterface<BadRender> {};

TEST_P(RenderRefuses, WithOneLineAndLeavesNothing) {
  const BadRender& bad = GetParam();
  const Outcome outcome =
      render(test::replaced_all(bad.arguments, "@", folder_.path("")), bad.environment);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.output,
              testing::AllOf(testing::StartsWith("seam: "), HasSubstr(bad.message)));
  EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
  EXPECT_THAT(pictures(), testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    , RenderRefuses,
    testing::Values(
        BadRender{"NoDriver", "-o @a.png", "__EGL_VENDOR_LIBRARY_FILENAMES=/nowhere",
                  "EGL: no driver for OpenGL 3.3 is there, it is needed for pictures (Debian: "
                  "libegl1 libegl-mesa0 libgl1-mesa-dri libopengl0)"},
        BadRender{"NoCard", "--device gpu -o @a.png",
                  "LIBGL_ALWAYS_SOFTWARE=1 "
                  "__EGL_VENDOR_LIBRARY_FILENAMES=/usr/share/glvnd/egl_vendor.d/50_mesa.json",
                  "EGL: no graphics card with OpenGL 3.3 can be used: its driver must be "
                  "installed, and you must be allowed to open /dev/dri/render* or /dev/nvidia*"},
        BadRender{"NoSoftware", "--device software -o @a.png",
                  "__EGL_VENDOR_LIBRARY_FILENAMES=/nowhere",
                  "EGL: llvmpipe is not there, it is needed for pictures without a graphics card "
                  "(Debian: libegl1 libegl-mesa0 libgl1-mesa-dri libopengl0)"},
        BadRender{"OtherSoftware", "--device software -o @a.png", "GALLIUM_DRIVER=softpipe",
                  "EGL: llvmpipe is not there"},
        BadRender{"NoFfmpeg", "-o @a.mp4", "PATH=/nowhere",
                  "ffmpeg: cannot be run, it is needed for movies (Debian: ffmpeg)"},
        BadRender{"NoFolder", "-o @nowhere/a.png", "", "a.png: cannot be written"},
        BadRender{"NoFolderForAMovie", "-o @nowhere/a.mp4", "", "a.mp4: cannot be written"},
        BadRender{"UnknownEnding", "-o @a.gif", "", "must end with .png, .mp4, .webm or .webp"},
        BadRender{"BadSize", "-o @a.png --size 10x10", "", "--size: \"10x10\", must be"},
        BadRender{"SizeInWords", "-o @a.png --size large", "", "--size: \"large\", must be"},
        BadRender{"TooLate", "-o @a.png --at 99", "", "--at: 99 s, must be in 0 to 3.52 s"},
        BadRender{"NotANumber", "-o @a.png --at nan", "", "--at: nan, must be a finite number"},
        BadRender{"Backwards", "-o @a.mp4 --from 2 --to 1", "", "--to: 1 s, must be > --from 2 s"},
        BadRender{"StillOfAMovie", "-o @a.mp4 --at 1", "", "--at: is for a still picture"},
        BadRender{"NoSuchRun", "-o @a.png --compare dmp2,dmp7", "",
                  "dmp7.replay.json: cannot be read"},
        BadRender{"UnknownDevice", "-o @a.png --device x", "", "must be auto, gpu or software"},
        BadRender{"UnknownCamera", "-o @a.png --camera x", "", "--camera"}),
    [](const auto& bad) { return std::string(bad.param.name); });

}  // namespace
}  // namespace seam
