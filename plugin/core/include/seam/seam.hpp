#pragma once

// The core of seam, in the order in which the data flows.
#include <seam/error.hpp>
#include <seam/demonstration.hpp>
#include <seam/primitive.hpp>
#include <seam/learn.hpp>
#include <seam/join.hpp>
#include <seam/sequence.hpp>
#include <seam/execution.hpp>
#include <seam/sequencer.hpp>
#include <seam/recording.hpp>
#include <seam/metrics.hpp>
