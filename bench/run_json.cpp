#include "bench/run_json.hpp"

#include <LinearMath/btScalar.h>

#include "bench/columns.hpp"

namespace seam {

nlohmann::ordered_json to_json(const Run& run) {
  auto joins = nlohmann::ordered_json::array();
  for (const JoinMetrics& join : run.metrics.joins) {
    nlohmann::ordered_json metrics;
    for (const JoinColumn& column : join_columns(run.recording))
      metrics[column.name] = join.*column.of;
    joins.push_back({{"time", join.time}, {"metrics", metrics}});
    if (join.joint >= 0)
      joins.back()["joint"] = run.recording.joints[static_cast<std::size_t>(join.joint)];
  }
  nlohmann::ordered_json metrics;
  for (const Column& column : columns(run.recording)) metrics[column.name] = column.of(run);
  nlohmann::ordered_json json{{"joins", joins}, {"metrics", metrics}};
  if (!run.recording.incident.empty()) json["incident"] = run.recording.incident;
  return json;
}

nlohmann::ordered_json versions_json(const std::string& seam_version) {
  return {{"seam", seam_version}, {"bullet", BT_BULLET_VERSION}};
}

}  // namespace seam
