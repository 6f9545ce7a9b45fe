#pragma once

/// @namespace seam
/// Everything of seam: what is declared where is in the reference's list of headers.

// The core of seam, in the order in which the data flows.
#include <seam/coupling.hpp>
#include <seam/demonstration.hpp>
#include <seam/error.hpp>
#include <seam/execution.hpp>
#include <seam/glide.hpp>
#include <seam/join.hpp>
#include <seam/learn.hpp>
#include <seam/metrics.hpp>
#include <seam/obstacles.hpp>
#include <seam/orientation.hpp>
#include <seam/period.hpp>
#include <seam/primitive.hpp>
#include <seam/recording.hpp>
#include <seam/recursive_learner.hpp>
#include <seam/rollout.hpp>
#include <seam/sequence.hpp>
#include <seam/sequencer.hpp>
#include <seam/switch.hpp>
#include <seam/wish.hpp>
