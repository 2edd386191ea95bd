// Riding a bicycle. Nine actions, 3 x (torque on the handlebars) + (the rider's displacement): -2,
// 0, 2 Nm and -2, 0, 2 cm, both to the left when positive; uniform noise is added to the
// displacement. It falls when it tilts by more than 12 degrees.
//
//   phi = omega + atan (d / h)                              tilt of bicycle and rider together
//   omega'' = (M h g sin phi - cos phi (I_dc s' theta' + sign(theta) v^2
//              (M_d r (1/r_f + 1/r_b) + M h / r_CM))) / I_bike          s' = v / r
//   theta'' = (T - I_dv s' omega') / I_dl
//   r_f = l / |sin theta|,  r_b = l / |tan theta|,  r_CM = sqrt((l - c)^2 + l^2 / tan^2 theta)
//
// integration=original, Randlov and Alstrom's: the rates are stepped first and the angles with the
// new rates; handlebars at the 80 degrees stop keep their rate; each tyre moves v dt along its
// heading, turned by asin(v dt / (2 r)) with the heading's own sign (of psi + theta in front, of
// psi behind), and the back tyre is moved when the wheelbase is off by more than 1 cm.
// integration=euler, of Ernst, Geurts and Wehenkel 2005, "Tree-based batch mode reinforcement
// learning", JMLR 6: all from the old values; the stop takes the rate away; the back tyre moves v
// dt along psi, and psi turns by sign(theta) v dt / r_b.
//
// task=balance: -1 for falling, else 0. task=goal: the goal, 10 m around (1000, 0), is worth 0.01
// once the front tyre is in it; the start is upright at the origin, with `heading` degrees between
// bicycle and goal, to the left.
// shaping=standard: with task=goal each other step is worth (4 - psi_goal^2) 0.00004, psi_goal in
// radians (Randlov and Alstrom; not potential-based). shaping=potential (Ng, Harada, Russell 1999):
// discount P(next) - P(now) on top of the task's own reward, with P = -weight |psi_goal|, or
// -weight (omega / 12 degrees)^2 when balancing, and 0 in ends: it changes no optimal policy.
//
// Observed: theta, theta', omega, omega', omega'' of the last step, and with task=goal psi_goal.
// Draws: a start takes one number only with any_heading, a step one, the noise: low + (high - low)
// u. JSON state: an object of omega, omega_rate, omega_acceleration, theta, theta_rate, x_front,
// y_front, x_back, y_back, psi.

#include "quoll/env/worlds/bicycle.hpp"

#include <algorithm>

#include "quoll/env/dynamics.hpp"
#include "quoll/env/world.hpp"

namespace quoll {
namespace {

// Randlov and Alstrom 1998, appendix.
constexpr double dt = 0.01;
constexpr double v = 10.0 / 3.6;  // speed
constexpr double g = 9.82;
constexpr double d_cm = 0.3;  // from the bicycle's centre of mass up to the rider's
constexpr double c = 0.66;    // from the front tyre back to the centre of mass
constexpr double h = 0.94;    // height of the centre of mass
constexpr double m_c = 15.0, m_d = 1.7, m_p = 60.0;  // bicycle, tyre, rider
constexpr double m = m_c + m_p;
constexpr double r = 0.34;  // of a tyre
constexpr double l = Bicycle::length;
constexpr double tyre_rate = v / r;
constexpr double i_bike = 13.0 / 3.0 * m_c * h * h + m_p * (h + d_cm) * (h + d_cm);
constexpr double i_dc = m_d * r * r;
constexpr double i_dv = 1.5 * m_d * r * r;
constexpr double i_dl = 0.5 * m_d * r * r;
constexpr double slack = 0.01;  // of the wheelbase

using Position = Bicycle::Position;

double sign(double x) {
  return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0;
}

// The curvatures of the paths: one over each radius.
struct Curvatures {
  double front, back, centre;

  explicit Curvatures(double theta) {
    const double tangent = std::fabs(math::tan(theta));
    front = std::fabs(math::sin(theta)) / l;
    back = tangent / l;
    centre = tangent / std::sqrt((l - c) * (l - c) * tangent * tangent + l * l);
  }
};

struct Accelerations {
  double omega, theta;
};

Accelerations accelerations(const Position& at, const Curvatures& curve, Action action,
                            double sway) {
  const Action push = action / 3, lean = action % 3;
  const double torque = 2.0 * (static_cast<double>(push) - 1.0);
  const double displacement = 0.02 * (static_cast<double>(lean) - 1.0) + sway;
  const double phi = at.omega + math::atan(displacement / h);
  const double turning =
      sign(at.theta) * v * v * (m_d * r * (curve.front + curve.back) + m * h * curve.centre);
  const double spin = i_dc * tyre_rate * at.theta_rate;
  return {(m * h * g * math::sin(phi) - math::cos(phi) * (spin + turning)) / i_bike,
          (torque - i_dv * tyre_rate * at.omega_rate) / i_dl};
}

void move(double& x, double& y, double heading) {
  x -= v * dt * math::sin(heading);
  y += v * dt * math::cos(heading);
}

void step_original(Position& at, Accelerations by, const Curvatures& curve) {
  at.omega_rate += by.omega * dt;
  at.omega += at.omega_rate * dt;
  at.theta_rate += by.theta * dt;
  at.theta = std::clamp(at.theta + at.theta_rate * dt, -Bicycle::stop, Bicycle::stop);

  const double front = at.psi + at.theta;
  move(at.x_front, at.y_front, front + sign(front) * math::asin(0.5 * v * dt * curve.front));
  move(at.x_back, at.y_back, at.psi + sign(at.psi) * math::asin(0.5 * v * dt * curve.back));

  const double x = at.x_back - at.x_front, y = at.y_back - at.y_front;
  const double wheelbase = std::sqrt(x * x + y * y);
  if (std::fabs(wheelbase - l) > slack) {
    at.x_back += x * (l - wheelbase) / wheelbase;
    at.y_back += y * (l - wheelbase) / wheelbase;
  }
  at.psi = math::atan2(at.x_back - at.x_front, at.y_front - at.y_back);
}

void place_front(Position& at) {
  at.x_front = at.x_back - l * math::sin(at.psi);
  at.y_front = at.y_back + l * math::cos(at.psi);
}

void step_euler(Position& at, Accelerations by, const Curvatures& curve) {
  move(at.x_back, at.y_back, at.psi);
  at.psi += sign(at.theta) * v * dt * curve.back;
  if (std::fabs(at.psi) > Bicycle::pi) at.psi -= sign(at.psi) * 2.0 * Bicycle::pi;
  place_front(at);

  at.omega += at.omega_rate * dt;
  at.omega_rate += by.omega * dt;
  at.theta += at.theta_rate * dt;
  at.theta_rate += by.theta * dt;
  if (std::fabs(at.theta) > Bicycle::stop) {
    at.theta = sign(at.theta) * Bicycle::stop;
    at.theta_rate = 0.0;
  }
}

}  // namespace

void BicycleSettings::describe(Describer& describe) {
  describe.choice("integration", integration, integration_names,
                  "how a step is computed: Randlov and Alstrom's program, or Ernst's Euler steps");
  describe.choice("task", task, bicycle_task_names, "stay upright, or ride to a goal 1000 m away");
  describe.choice("shaping", shaping, shaping_names,
                  "standard: the paper's reward for heading to the goal; potential: keeps optima");
  describe("shaping_weight", shaping_weight, 0.0, 1e6, "scale of the potential");
  describe("noise", noise, 0.0, 1.0, "largest error of the rider's displacement, in metres");
  describe("heading", heading, -180.0, 180.0,
           "degrees from the goal's direction to the start's, to the left");
  describe("any_heading", any_heading, "start with a uniformly random heading");
  describe("discount", discount, std::numeric_limits<double>::denorm_min(), 1.0,
           "the reward's factor per step");
}

std::string_view BicycleSettings::needs(std::string_view name) const {
  const bool to_goal = task == BicycleTask::goal;
  if (name == "shaping" && shaping == Shaping::standard && !to_goal) return "task=goal";
  if (name == "shaping_weight" && shaping != Shaping::potential) return "shaping=potential";
  if ((name == "heading" || name == "any_heading") && !to_goal) return "task=goal";
  return name == "heading" && any_heading ? "any_heading=false" : "";
}

void Track::add(double at_x, double at_y) {
  if (wait > 0) {
    --wait;
    return;
  }
  constexpr std::size_t most = 512;
  if (x.size() == most) {  // every second point goes
    for (std::size_t i = 0; i < most / 2; ++i) {
      x[i] = x[2 * i];
      y[i] = y[2 * i];
    }
    x.resize(most / 2);
    y.resize(most / 2);
    stride *= 2;
  }
  x.push_back(at_x);
  y.push_back(at_y);
  wait = stride - 1;
}

void Track::persist(Archive& archive) {
  archive("x", x);
  archive("y", y);
  archive("stride", stride);
  archive("wait", wait);
  if (!archive.saving() && (x.size() != y.size() || stride == 0 || wait >= stride)) {
    archive.fail("a track that cannot be");
  }
}

const char* Bicycle::Position::impossible() const {
  for (const double x : {omega, omega_rate, omega_acceleration, theta, theta_rate, x_front, y_front,
                         x_back, y_back, psi}) {
    if (!std::isfinite(x)) return "a number that is not finite";
  }
  if (std::fabs(theta) > stop) return "theta beyond the handlebars' stop at 80 degrees";
  if (std::fabs(psi) > pi) return "psi beyond pi";
  const double x = x_front - x_back, y = y_front - y_back;
  if (std::fabs(std::sqrt(x * x + y * y) - length) > 2.0 * slack) {
    return "tyres that are not 1.11 m apart";
  }
  if (std::fabs(x * math::cos(psi) + y * math::sin(psi)) > slack ||
      y * math::cos(psi) < x * math::sin(psi)) {
    return "tyres that do not stand along psi";
  }
  return nullptr;
}

Spaces Bicycle::spaces() const {
  return {9, 0, settings.task == BicycleTask::goal ? 6u : 5u, {}, false};
}

// Angles between what ends or stops them; rates as far as Randlov and Alstrom's boxes tell apart,
// twice over.
std::vector<Measured> Bicycle::measured() const {
  std::vector<Measured> numbers{{"theta", -stop, stop},
                                {"theta rate", -4.0, 4.0},
                                {"omega", -fall, fall},
                                {"omega rate", -1.0, 1.0},
                                {"omega acceleration", -4.0, 4.0}};
  if (settings.task == BicycleTask::goal) numbers.push_back({"psi", -pi, pi});
  return numbers;
}

std::vector<std::string> Bicycle::action_names() const {
  return {"steer-right lean-right",
          "steer-right",
          "steer-right lean-left",
          "lean-right",
          "still",
          "lean-left",
          "steer-left lean-right",
          "steer-left",
          "steer-left lean-left"};
}

Position Bicycle::start_at(double degrees) const {
  Position at;
  at.psi = (degrees - 90.0) * pi / 180.0;  // the goal lies in the east
  if (at.psi < -pi) at.psi += 2.0 * pi;
  place_front(at);
  at.track.add(at.x_front, at.y_front);
  return at;
}

Feedback Bicycle::ride(Position& at, Action action, double sway) const {
  if (fallen(at) || at_goal(at)) return {0.0, true, false};
  const Curvatures curve(at.theta);
  const Accelerations by = accelerations(at, curve, action, sway);
  const double before = settings.shaping == Shaping::potential ? potential(at) : 0.0;
  at.omega_acceleration = by.omega;
  if (settings.integration == Integration::original) {
    step_original(at, by, curve);
  } else {
    step_euler(at, by, curve);
  }
  at.track.add(at.x_front, at.y_front);
  Feedback feedback{0.0, true, false};
  if (fallen(at)) {
    feedback.reward = -1.0;
  } else if (at_goal(at)) {
    feedback.reward = 0.01;
  } else {
    feedback.terminated = false;
    if (settings.task == BicycleTask::goal && settings.shaping == Shaping::standard) {
      const double angle = angle_to_goal(at);
      feedback.reward = (4.0 - angle * angle) * 0.00004;
    }
  }
  if (settings.shaping == Shaping::potential) {
    const double after = feedback.terminated ? 0.0 : potential(at);
    feedback.reward += settings.discount * after - before;
  }
  return feedback;
}

void Bicycle::observe(const Position& at, std::span<float> x) const {
  const double seen[] = {at.theta,      at.theta_rate,         at.omega,
                         at.omega_rate, at.omega_acceleration, angle_to_goal(at)};
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<float>(seen[i]);
}

double Bicycle::angle_to_goal(const Position& at) {
  const double ahead_x = at.x_front - at.x_back, ahead_y = at.y_front - at.y_back;
  const double goal_east = goal_x - at.x_front, goal_north = goal_y - at.y_front;
  return math::atan2(ahead_x * goal_north - ahead_y * goal_east,
                     ahead_x * goal_east + ahead_y * goal_north);
}

bool Bicycle::at_goal(const Position& at) const {
  if (settings.task != BicycleTask::goal) return false;
  const double x = goal_x - at.x_front, y = goal_y - at.y_front;
  return x * x + y * y <= goal_radius * goal_radius;
}

double Bicycle::potential(const Position& at) const {
  if (settings.task == BicycleTask::goal) {
    return -settings.shaping_weight * std::fabs(angle_to_goal(at));
  }
  const double share = at.omega / fall;
  return -settings.shaping_weight * share * share;
}

namespace {

Result<World> make(const Parameters& parameters) {
  const Result<BicycleSettings> settings = read_parameters<BicycleSettings>("bicycle", parameters);
  if (!settings) return settings.error();
  WorldFacts facts;
  facts.discount = settings->discount;
  // 1,000 s upright is balancing; a goal is given 10,000 s, four times the paper's early rides.
  facts.episode_steps = settings->task == BicycleTask::balance ? 100'000 : 1'000'000;
  facts.traits.deterministic = settings->noise == 0.0 && !settings->any_heading;
  if (settings->shaping != Shaping::potential) {
    facts.traits.reward_bounds = {-1.0, settings->task == BicycleTask::balance ? 0.0 : 0.01};
  }
  return to_world("bicycle", Bicycle{*settings}, facts);
}

}  // namespace

extern const WorldEntry bicycle_world;
const WorldEntry bicycle_world{"bicycle",
                               "",
                               "balance a bicycle, or ride it to a goal",
                               "Randlov and Alstrom 1998; Ernst, Geurts and Wehenkel 2005",
                               make,
                               parameters_of<BicycleSettings>};

}  // namespace quoll
