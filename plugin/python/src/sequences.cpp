// Joins, sequences, and what plays them.
#include "plugin/python/src/bind.hpp"
#include "plugin/python/src/couplings.hpp"
#include "plugin/python/src/parts.hpp"
#include "plugin/python/src/states.hpp"
#include <seam/execution.hpp>
#include <seam/rollout.hpp>
#include <seam/sequence_file.hpp>
#include <seam/sequencer.hpp>
#include <seam/time_scale.hpp>

namespace seam::python {

namespace {

void bind_join(py::module_& module) {
  Enum<Join>(module, "Join", "Join")
      .value("dmp2", Join::dmp2)
      .value("dmp2a", Join::dmp2a)
      .value("dmp3", Join::dmp3)
      .value("dmp2j", Join::dmp2j);
  module.attr("all_joins") =
      py::tuple(py::cast(std::vector<Join>(all_joins.begin(), all_joins.end())));
  def(module, "join_from_name", &join_from_name, py::arg("name"));
  Enum<WeightChange>(module, "WeightChange", "WeightChange")
      .value("smallest", WeightChange::smallest)
      .value("first", WeightChange::first)
      .value("strongest", WeightChange::strongest);
  Class<JoinSettings>(module, "JoinSettings")
      .field("method", &JoinSettings::method)
      .field("change", &JoinSettings::change)
      .made_of_fields();
  Class<Sample> sample(module, "Sample");
  sample.field("position", &Sample::position)
      .field("velocity", &Sample::velocity)
      .field("acceleration", &Sample::acceleration)
      .field("jerk", &Sample::jerk)
      .made_of_fields();
  sample.def_static(
      "at_rest",
      [](const Numbers& position) { return Sample::at_rest(position.vector("position")); },
      py::arg("position"));
}

void bind_switches(py::module_& module) {
  Class<Switch> change(module, "Switch");
  Enum<Switch::When>(*change, "When", "Switch::When")
      .value("after", Switch::When::after)
      .value("before_end", Switch::When::before_end)
      .value("at_phase", Switch::When::at_phase)
      .value("near_goal", Switch::When::near_goal)
      .value("cycles", Switch::When::cycles)
      .value("on_call", Switch::When::on_call);
  change.field("when", &Switch::when).field("value", &Switch::value).made_of_fields();
  def(module, "after", &after, py::arg("seconds"));
  def(module, "before_end", &before_end, py::arg("seconds"));
  def(module, "at", &at, py::arg("seconds"));
  def(module, "at_end", &at_end);
  def(module, "at_phase", &at_phase, py::arg("phase"));
  def(module, "near_goal", &near_goal, py::arg("distance"));
  def(module, "after_cycles", &after_cycles, py::arg("cycles"));
  def(module, "on_call", &on_call);

  Class<Entry> entry(module, "Entry");
  Enum<Entry::Where>(*entry, "Where", "Entry::Where")
      .value("beginning", Entry::Where::beginning)
      .value("phase", Entry::Where::phase)
      .value("least_correction", Entry::Where::least_correction);
  entry.field("where", &Entry::where).field("phase", &Entry::phase).made_of_fields();
  def(module, "from_phase", &from_phase, py::arg("phase"));
  def(module, "least_correction", &least_correction);
}

void bind_wishes(py::module_& module) {
  Class<Wish> wish(module, "Wish");
  Enum<Wish::Then>(*wish, "Then", "Wish::Then")
      .value("go_on", Wish::Then::go_on)
      .value("hand_over", Wish::Then::hand_over)
      .value("stay", Wish::Then::stay);
  wish.field("when", &Wish::when)
      .field("position", &Wish::position)
      .field("velocity", &Wish::velocity)
      .field("acceleration", &Wish::acceleration)
      .field("then", &Wish::then)
      .field("smooth", &Wish::smooth)
      .made_of_fields();
  module.def(
      "pass_",
      [](const Numbers& position, const Switch& when) {
        return pass(position.vector("position"), when);
      },
      doc("pass"), py::arg("position"), py::arg("when"));
  def(
      module, "hit",
      [](const Numbers& position, const Numbers& velocity, const Switch& when) {
        return hit(position.vector("position"), velocity.vector("velocity"), when);
      },
      py::arg("position"), py::arg("velocity"), py::arg("when"));
  def(module, "arrive", &arrive, py::arg("when") = at_end(), py::arg("smooth") = true);
  module.attr("most_wishes") = most_wishes;
  Class<Price>(module, "Price")
      .field("possible", &Price::possible)
      .field("deviation", &Price::deviation)
      .field("acceleration", &Price::acceleration)
      .made_of_fields();
}

// Refuses what set_wish cannot know how to read.
const Wish& fitting(const Wish& wish, int dimensions) {
  const std::pair<const char*, const Eigen::VectorXd&> all[] = {
      {"position", wish.position},
      {"velocity", wish.velocity},
      {"acceleration", wish.acceleration}};
  for (const auto& [name, values] : all)
    if (values.size() != 0) require_shape(values, dimensions, 1, name);
  return wish;
}

// What one who plays can be asked and told of wishes.
template <typename Player>
void bind_wishing(Class<Player>& player) {
  player
      .def(
          "set_wish",
          [](Player& self, int which, const Wish& wish) {
            return self.set_wish(which, fitting(wish, self.dimensions()));
          },
          py::arg("which"), py::arg("wish"))
      .def("drop_wishes", &Player::drop_wishes)
      .def(
          "price_of",
          [](Player& self, int which, const Wish& wish) {
            return Price(self.price_of(which, fitting(wish, self.dimensions())));
          },
          py::arg("which"), py::arg("wish"))
      .property("price", [](const Player& self) { return Price(self.price()); })
      .property("wishes", &Player::wishes)
      .property("wishes_hold", &Player::wishes_hold);
}

Sequence sequence_of(const std::vector<Sequence::Step>& steps, double start_delay) {
  Sequence sequence;
  if (start_delay != 0.0) sequence.start_after(start_delay);
  for (const Sequence::Step& step : steps) sequence.then(step);
  return sequence;
}

void bind_sequence(py::module_& module) {
  Class<Sequence> sequence(module, "Sequence");
  Class<Sequence::Step>(*sequence, "Step", "Sequence::Step")
      .field("primitive", &Sequence::Step::primitive)
      .field("until", &Sequence::Step::until)
      .field("entry", &Sequence::Step::entry)
      .field("wishes", &Sequence::Step::wishes)
      .field("leave", &Sequence::Step::leave)
      .made_of_fields();
  (*sequence)
      .def(py::init<>(), "Empty: primitives are added by `then`.")
      .def(py::pickle(
          [](const Sequence& self) { return py::make_tuple(self.steps(), self.start_delay()); },
          [](const py::tuple& state) {
            return sequence_of(state[0].cast<std::vector<Sequence::Step>>(),
                               state[1].cast<double>());
          }))
      .def(
          "__len__", [](const Sequence& self) { return self.steps().size(); },
          "Number of primitives.")
      .def("__repr__", [](const Sequence& self) {
        return "<Sequence of " + std::to_string(self.steps().size()) + " primitives>";
      });
  const auto itself = py::return_value_policy::reference;
  sequence
      .def(
          "start_after",
          [](Sequence& self, double seconds) -> Sequence& { return self.start_after(seconds); },
          py::arg("seconds"), itself)
      .def(
          "then",
          [](Sequence& self, const Primitive& primitive, const std::optional<Switch>& until,
             const std::optional<Entry>& enter) -> Sequence& {
            Sequence alone;  // refuses what will not do before anything is changed
            alone.then(primitive);
            if (until) alone.until(*until);
            if (enter) alone.enter(*enter);
            self.then(primitive);
            if (until) self.until(*until);
            if (enter) self.enter(*enter);
            return self;
          },
          py::arg("primitive"), py::arg("until") = py::none(), py::arg("enter") = py::none(),
          itself)
      .def(
          "until", [](Sequence& self, const Switch& when) -> Sequence& { return self.until(when); },
          py::arg("when"), itself)
      .def(
          "enter",
          [](Sequence& self, const Entry& entry) -> Sequence& { return self.enter(entry); },
          py::arg("entry"), itself)
      .def_as(
          "pass_", "pass",
          [](Sequence& self, const Values& position, const Switch& when) -> Sequence& {
            return self.pass(position, when);
          },
          py::arg("position"), py::arg("when"), itself)
      .def(
          "hit",
          [](Sequence& self, const Values& position, const Values& velocity,
             const Switch& when) -> Sequence& { return self.hit(position, velocity, when); },
          py::arg("position"), py::arg("velocity"), py::arg("when"), itself)
      .def(
          "arrive",
          [](Sequence& self, const Switch& when, bool smooth) -> Sequence& {
            return self.arrive(when, smooth);
          },
          py::arg("when") = at_end(), py::arg("smooth") = true, itself)
      .def(
          "leave",
          [](Sequence& self, const Values& acceleration) -> Sequence& {
            return self.leave(acceleration);
          },
          py::arg("acceleration"), itself)
      .def(
          "wish", [](Sequence& self, const Wish& wish) -> Sequence& { return self.wish(wish); },
          py::arg("wish"), itself)
      .property("start_delay", &Sequence::start_delay)
      .property("steps",
                [](const Sequence& self) {
                  return TupleOf<Sequence::Step>{py::tuple(py::cast(self.steps()))};
                })
      .property("coordinates",
                [](const Sequence& self) {
                  return TupleOf<std::string>{py::tuple(py::cast(self.coordinates()))};
                })
      .property("duration", &Sequence::duration)
      .def("start_state", &Sequence::start_state);
}

void bind_files(py::module_& module) {
  Class<SequenceFile> file(module, "SequenceFile");
  file.field("sequence", &SequenceFile::sequence)
      .field("primitives", &SequenceFile::primitives)
      .field("start", &SequenceFile::start)
      .field("couplings", &SequenceFile::couplings)
      .made_of_fields();
  file.def("start_state", [](const SequenceFile& self) { return self.start_state(); });
  def(
      module, "read_sequence",
      [](const Path& path, const std::vector<std::string>& allowed) {
        return read_sequence(path, allowed);
      },
      py::arg("path"), py::arg("allowed") = std::vector<std::string>{},
      py::call_guard<py::gil_scoped_release>());
  def(
      module, "write_sequence",
      [](const Path& path, const SequenceFile& content) {
        const SequenceFile as_it_is = content;  // others may change theirs meanwhile
        py::gil_scoped_release others_go_on;
        write_sequence(path, as_it_is);
      },
      py::arg("path"), py::arg("file"));
}

void require_phase(const Execution& execution, double phase) {
  const bool discrete = execution.kind() == Kind::discrete;
  if (discrete ? !(phase > 0.0 && phase <= 1.0) : !std::isfinite(phase))
    throw Error("execution", "phase " + std::to_string(phase) +
                                 (discrete ? ", must be in (0, 1]" : ", must be finite"));
}

void bind_execution(py::module_& module) {
  Class<Execution> execution(module, "Execution");
  execution
      .init(
          [](const Primitive& primitive, const std::vector<Wish>& wishes,
             const std::optional<Numbers>& leave) {
            return Execution(
                primitive, wishes,
                leave ? leave->vector("leave", primitive.dimensions()) : Eigen::VectorXd());
          },
          py::arg("primitive"), py::arg("wishes") = std::vector<Wish>{},
          py::arg("leave") = py::none())
      .def(
          "require_possible",
          [](Execution& self, double phase, const JoinChoice& join) {
            require_phase(self, phase);
            self.require_possible(phase, join.value);
          },
          py::arg("phase"), py::arg("join") = "dmp3")
      .def(
          "resume",
          [](Execution& self, const Start& at) { self.resume(at.of(self.dimensions(), "from")); },
          py::arg("from_"))
      .def(
          "reinitialise",
          [](Execution& self, const Start& at, double phase, const JoinChoice& join) {
            require_phase(self, phase);
            self.reinitialise(at.of(self.dimensions(), "from"), phase, join.value);
          },
          py::arg("from_"), py::arg("phase"), py::arg("join") = "dmp3")
      .def(
          "step", [](Execution& self, double dt) { self.step(require_step(dt)); }, py::arg("dt"))
      .def(
          "set_goal",
          [](Execution& self, const Numbers& goal) {
            return self.set_goal(goal.vector("goal", self.dimensions()));
          },
          py::arg("goal"))
      .def("set_tau", &Execution::set_tau,
           "Time constant tau [s] of what runs now. False, and no change, where nothing runs yet "
           "or the value will not do.",
           py::arg("tau"))
      .def("set_amplitude", &Execution::set_amplitude,
           "Amplitude of what runs now, a rhythmic primitive; 1 as learned. False, and no change, "
           "where nothing rhythmic runs or the value will not do.",
           py::arg("amplitude"))
      .def(
          "couple",
          [](Execution& self, const py::object& coupling, double time) {
            self.couple(coupling.is_none() ? nullptr : kept(coupling), time);
          },
          py::arg("coupling"), py::arg("time"))
      .property("sample", [](const Execution& self) { return Sample(self.sample()); })
      .property("state", [](Execution& self) { return Sample(self.state()); })
      .def(
          "correction",
          [](Execution& self, const Start& at, double phase) {
            require_phase(self, phase);
            return self.correction(at.of(self.dimensions(), "from"), phase);
          },
          py::arg("from_"), py::arg("phase"))
      .def(
          "least_correction_phase",
          [](Execution& self, const Start& at) {
            if (self.kind() == Kind::discrete)
              throw Error("execution",
                          "is discrete, must be rhythmic to have a phase of least correction");
            return self.least_correction_phase(at.of(self.dimensions(), "at"));
          },
          py::arg("at"))
      .property("kind", &Execution::kind)
      .property("basis", [](const Execution& self) { return Basis(self.basis()); })
      .property("phase", &Execution::phase)
      .property("tau", &Execution::tau)
      .property("amplitude", &Execution::amplitude)
      .property("goal", [](const Execution& self) { return Eigen::VectorXd(self.goal()); })
      .property("dimensions", &Execution::dimensions);
  bind_wishing(execution);
}

void bind_sequencer(py::module_& module) {
  Class<JoinEvent>(module, "JoinEvent")
      .field("time", &JoinEvent::time)
      .field("primitive", &JoinEvent::primitive)
      .field("acceleration_before", &JoinEvent::acceleration_before)
      .field("acceleration_after", &JoinEvent::acceleration_after)
      .field("jerk_before", &JoinEvent::jerk_before)
      .field("jerk_after", &JoinEvent::jerk_after)
      .field("price", &JoinEvent::price)
      .made_of_fields();

  Class<Sequencer> sequencer(module, "Sequencer");
  sequencer
      .init(
          [](const Sequence& sequence, const JoinChoice& join, const std::optional<Start>& start) {
            const Sample from =
                start ? start->of(static_cast<int>(sequence.coordinates().size()), "start")
                      : sequence.start_state();
            return Sequencer(sequence, join.value, from);
          },
          py::arg("sequence"), py::arg("join") = "dmp3", py::arg("start") = py::none())
      .def(
          "step", [](Sequencer& self, double dt) { self.step(require_step(dt)); }, py::arg("dt"))
      .def("hand_over", &Sequencer::hand_over)
      .def(
          "set_goal",
          [](Sequencer& self, const Numbers& goal) {
            return self.set_goal(goal.vector("goal", self.dimensions()));
          },
          py::arg("goal"))
      .def("set_tau", &Sequencer::set_tau,
           "Time constant tau [s] of what runs now. False, and no change, where nothing runs yet "
           "or the value will not do.",
           py::arg("tau"))
      .def("set_amplitude", &Sequencer::set_amplitude,
           "Amplitude of what runs now, a rhythmic primitive; 1 as learned. False, and no change, "
           "where nothing rhythmic runs or the value will not do.",
           py::arg("amplitude"))
      .def("set_rate", &Sequencer::set_rate, py::arg("rate"), py::arg("over"))
      .def(
          "reinitialise",
          [](Sequencer& self, const Start& at) {
            return self.reinitialise(at.of(self.dimensions(), "at"));
          },
          py::arg("at"))
      .def(
          "add_coupling",
          [](Sequencer& self, const py::object& coupling) { self.add_coupling(kept(coupling)); },
          py::arg("coupling"))
      .def(
          "remove_coupling",
          [](Sequencer& self, const Coupling& coupling) {
            for (const auto& one : self.couplings())
              if (one.get() == &coupling) return self.remove_coupling(std::shared_ptr(one));
            return false;
          },
          py::arg("coupling"))
      .def("clear_couplings", &Sequencer::clear_couplings)
      .property("couplings",
                [](const Sequencer& self) {
                  return TupleOf<Coupling>{py::tuple(py::cast(self.couplings()))};
                })
      .def("append", &Sequencer::append, py::arg("sequence"))
      .def("replace", &Sequencer::replace, py::arg("sequence"))
      .def("clear", &Sequencer::clear)
      .property("sample", [](const Sequencer& self) { return Sample(self.sample()); })
      .property("state", [](Sequencer& self) { return Sample(self.state()); })
      .property("time", &Sequencer::time)
      .property("own_time", &Sequencer::own_time)
      .property("motion_time", &Sequencer::motion_time)
      .property("rate", &Sequencer::rate)
      .property("goal", [](const Sequencer& self) { return Eigen::VectorXd(self.goal()); })
      .property("running", &Sequencer::running)
      .property("phase", &Sequencer::phase)
      .property("finished", &Sequencer::finished)
      .property("changes", &Sequencer::changes)
      .property("dimensions", &Sequencer::dimensions)
      .property("coordinates",
                [](const Sequencer& self) {
                  return TupleOf<std::string>{py::tuple(py::cast(self.coordinates()))};
                })
      .property("joins", &Sequencer::joins)
      .property("first_join", &Sequencer::first_join)
      .def(
          "join",
          [](const Sequencer& self, int i) {
            if (i < self.first_join() || i >= self.joins())
              throw py::index_error("join " + std::to_string(i) + ", must be in " +
                                    std::to_string(self.first_join()) + " to " +
                                    std::to_string(self.joins() - 1));
            return JoinEvent(self.join(i));
          },
          "What happened at a join, a JoinEvent; 0 is the start.\n\nRaises:\n    IndexError: not "
          "first_join <= i < joins",
          py::arg("i"));
  bind_wishing(sequencer);
  (*sequencer).attr("kept_joins") = Sequencer::kept_joins;
  def(
      module, "add_obstacles",
      [](const std::vector<ObstacleSettings>& all, Sequencer& to) {
        return TupleOf<Obstacle>{py::tuple(py::cast(add_obstacles(all, to)))};
      },
      py::arg("all"), py::arg("sequencer"));

  Class<TimeScale> scale(module, "TimeScale");
  (*scale).def(py::init<>(), "Of rate 1.");
  scale.def("change", &TimeScale::change, py::arg("rate"), py::arg("over"))
      .def(
          "advance", [](TimeScale& self, double dt) { return self.advance(require_step(dt)); },
          py::arg("dt"))
      .property("rate", &TimeScale::rate)
      .property("rate_change", &TimeScale::rate_change)
      .property("rate_curvature", &TimeScale::rate_curvature)
      .property("is_real_time", &TimeScale::is_real_time);
}

void bind_rollout(py::module_& module) {
  Class<RolloutSettings>(module, "RolloutSettings")
      .field("dt", &RolloutSettings::dt)
      .field("settle", &RolloutSettings::settle)
      .field("duration", &RolloutSettings::duration)
      .field("longest", &RolloutSettings::longest)
      .made_of_fields();
  module.def(
      "rollout",
      [](const Sequence& sequence, const JoinChoice& join, const std::optional<Start>& start,
         double dt, double settle, double duration, double longest) {
        const RolloutSettings settings{dt, settle, duration, longest};
        const Sample from =
            start ? start->of(static_cast<int>(sequence.coordinates().size()), "start")
                  : sequence.start_state();
        const Sequence as_it_is = sequence;
        const JoinSettings joined = join.value;
        py::gil_scoped_release others_go_on;
        return rollout(as_it_is, joined, from, settings);
      },
      "Plays a sequence alone, without an arm: what the coordinates do, in rows at k·dt, and the "
      "joins.\n\nArgs:\n"
      "    join: how primitives are joined\n"
      "    start: a Sample, or positions (D,) to begin from at rest; None: where the first "
      "primitive's demonstration began\n"
      "    dt: [s] > 0, between rows\n"
      "    settle: [s] to go on after the last switch has been due\n"
      "    duration: [s] of it all, whatever has happened by then; 0: until the last switch and "
      "`settle`\n"
      "    longest: [s] after which a sequence that has not finished is given up\n\n"
      "Returns:\n    a Recording: ref, ref_vel, ref_acc of the coordinates, or tool_ref, tool_vel, "
      "tool_acc of a tool's (x y z, rx ry rz)\n\n"
      "Raises:\n    Error: what is out of range, more than 2e6 rows, or a sequence that has not "
      "finished after `longest`",
      py::arg("sequence"), py::arg("join") = "dmp3", py::arg("start") = py::none(), py::kw_only(),
      py::arg("dt") = 1e-3, py::arg("settle") = 1.0, py::arg("duration") = 0.0,
      py::arg("longest") = 600.0);
  module.def(
      "rollout",
      [](Sequencer& sequencer, double dt, double settle, double duration, double longest) {
        return rollout(sequencer, RolloutSettings{dt, settle, duration, longest});
      },
      "The same from a sequencer, which may have been changed before; it is advanced until the "
      "end.",
      py::arg("sequencer"), py::kw_only(), py::arg("dt") = 1e-3, py::arg("settle") = 1.0,
      py::arg("duration") = 0.0, py::arg("longest") = 600.0);
}

}  // namespace

void bind_sequences(py::module_& module) {
  bind_join(module);
  bind_switches(module);
  bind_wishes(module);
  bind_sequence(module);
  bind_files(module);
  bind_execution(module);
  bind_sequencer(module);
  bind_rollout(module);
}

}  // namespace seam::python
