#pragma once

namespace seam::micro {

// Each adds what it measures (see add_pair).
void add_step_benchmarks();
void add_tick_benchmarks();
void add_world_benchmarks();
void add_learn_benchmarks();
void add_jobs_benchmarks();

}  // namespace seam::micro
