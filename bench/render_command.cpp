#include "bench/render_command.hpp"

#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/progress.hpp"
#include "scenes/view/egl_context.hpp"
#include "scenes/view/movie.hpp"
#include "scenes/view/studio.hpp"
#include <seam/error.hpp>

namespace seam {

namespace {

constexpr int least_side = 64;
constexpr int largest_side = 8192;
constexpr int most_frames = 100000;

struct Options {
  std::string run;
  std::string out;
  std::string size = "1280x720";
  std::optional<double> at, from, to;  // [s]
  double fps = 30.0;
  std::vector<std::string> compared;
  std::string device = "auto";
  StudioSettings studio;
};

void read_size(const std::string& text, StudioSettings& settings) {
  char rest = 0;
  const bool read =
      std::sscanf(text.c_str(), "%dx%d%c", &settings.width, &settings.height, &rest) == 2;
  const auto in_range = [](int side) { return side >= least_side && side <= largest_side; };
  if (!read || !in_range(settings.width) || !in_range(settings.height))
    throw Error("--size", fmt::format("\"{}\", must be WIDTHxHEIGHT, each {} to {} pixels", text,
                                      least_side, largest_side));
}

// A replay's file, or the path of the recording beside it without its ending.
std::string replay_file(const std::string& run) {
  const std::string ending = ".replay.json";
  const bool whole = run.size() > ending.size() &&
                     run.compare(run.size() - ending.size(), ending.size(), ending) == 0;
  return whole ? run : run + ending;
}

// What is compared lies beside the run, or in it where that is a folder.
std::vector<Replay> read_replays(const Options& options) {
  namespace fs = std::filesystem;
  if (options.compared.empty()) return {Replay::read(replay_file(options.run))};
  std::error_code none;
  const fs::path folder = fs::is_directory(options.run, none) ? fs::path(options.run)
                                                              : fs::path(options.run).parent_path();
  std::vector<Replay> replays;
  for (const std::string& method : options.compared)
    replays.push_back(Replay::read(replay_file((folder / method).string())));
  return replays;
}

void require_inside(const char* option, std::optional<double> time, double duration) {
  if (time && !(*time >= 0.0 && *time <= duration))
    throw Error(option, fmt::format("{:g} s, must be in 0 to {:.2f} s", *time, duration));
}

void draw_movie(const Options& options, const Studio& studio) {
  const double from = options.from.value_or(0.0);
  const double to = options.to.value_or(studio.duration());
  if (to <= from) throw Error("--to", fmt::format("{:g} s, must be > --from {:g} s", to, from));
  const double frames = std::floor((to - from) / options.studio.speed * options.fps) + 1.0;
  if (frames > most_frames)
    throw Error("--speed", fmt::format("gives {:g} frames, must be <= {}", frames, most_frames));
  Movie movie(options.out, options.studio.width, options.studio.height, options.fps);
  const int count = static_cast<int>(frames);
  ProgressLine line;
  for (int i = 0; i < count; ++i) {
    const double time = from + i * options.studio.speed / options.fps;
    movie.add(studio.at(time, static_cast<double>(i) / count));
    line.show(i + 1, count, "frames of " + options.out);
  }
  movie.finish();
}

void render(Options options) {
  read_size(options.size, options.studio);
  const bool moves = Movie::is_movie(options.out);
  if (!moves && std::filesystem::path(options.out).extension() != ".png")
    throw Error(options.out, "must end with .png, .mp4, .webm or .webp");
  if (moves && options.at) throw Error("--at", "is for a still picture, .png");
  std::vector<Replay> replays = read_replays(options);
  const EglContext context(options.device);
  const Studio studio(std::move(replays), options.studio);
  require_inside("--at", options.at, studio.duration());
  require_inside("--from", options.from, studio.duration());
  require_inside("--to", options.to, studio.duration());
  if (moves)
    draw_movie(options, studio);
  else
    studio.at(options.at.value_or(studio.duration())).write_png(options.out);
  fmt::print("{}: {}, drawn by {}\n", options.out, options.size, context.renderer());
}

void add_times(CLI::App& command, Options& options) {
  command.add_option("--at", options.at, "[s] time of a still picture (default: the run's end)");
  command.add_option("--from", options.from, "[s] of the run where a movie begins (default: 0)");
  command.add_option("--to", options.to, "[s] of the run where a movie ends (default: its end)");
  command
      .add_option("--speed", options.studio.speed, "of a movie; 0.25: four times slower than life")
      ->check(CLI::Range(1e-3, 1e2))
      ->capture_default_str();
  command.add_option("--fps", options.fps, "[Hz] frames of a movie shown a second")
      ->check(CLI::Range(1.0, 120.0))
      ->capture_default_str();
}

void add_view(CLI::App& command, Options& options) {
  const std::map<std::string, View> views{
      {"scene", View::scene}, {"orbit", View::orbit}, {"close-up", View::close_up}};
  command.add_option("--size", options.size, "[pixels] WIDTHxHEIGHT of the whole picture")
      ->capture_default_str();
  command
      .add_option("--camera", options.studio.view,
                  "scene (the scene file's), orbit (once around in a movie) or close-up (follows "
                  "the glass, the grains or the tool) (default: scene)")
      ->transform(CLI::CheckedTransformer(views).description(""))
      ->type_name("NAME");
  command.add_flag("--inset", options.studio.inset, "a close-up in the picture's corner");
  command
      .add_option("--compare", options.compared,
                  "runs beside this one, shown side by side instead of it, e.g. dmp2,dmp3")
      ->allow_extra_args(false)
      ->delimiter(',');
  command
      .add_option("--device", options.device,
                  "what draws: gpu, software, or auto: a graphics card where there is one")
      ->capture_default_str();
}

}  // namespace

void add_render_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App& command =
      *app.add_subcommand("render", "draw a run that seam bench or seam run has left");
  command
      .add_option("run", options->run,
                  "RESULTS/SCENE/METHOD, a replay (.replay.json), or with --compare RESULTS/SCENE")
      ->required();
  command
      .add_option("-o,--out", options->out,
                  "picture (.png), movie (.mp4, .webm) or animated picture (.webp) to write")
      ->required();
  add_times(command, *options);
  add_view(command, *options);
  command.callback([options] { render(*options); });
}

}  // namespace seam
