// SPDX-License-Identifier: Apache-2.0
#include "steering_words.h"

#include <algorithm>
#include <cmath>

// Formula numbers are those of J. Reeds and L. Shepp, "Optimal paths for a car that goes both forwards and backwards",
// Pacific Journal of Mathematics 145(2), 1990. All of it at radius 1 from the pose (0, 0, 0) to (x, y, phi).

namespace external_command {

namespace {

constexpr double kHalfPi = M_PI / 2.0;
constexpr double kZero = 1e-12;
constexpr double kSameCircle = 1e-9;  ///< centres nearer than this are one
constexpr double kFullCircle = 1e-8;  ///< a turn this little below zero is none, not a full circle [rad]

enum Steer : int { kR = -1, kS = 0, kL = 1 };

/// Faster than std::remainder for the few turns that occur here.
double wrap(double angle) {
  while (angle > M_PI) angle -= 2.0 * M_PI;
  while (angle < -M_PI) angle += 2.0 * M_PI;
  return angle;
}

double wrapPositive(double angle) {
  angle = wrap(angle);
  return angle < -kFullCircle ? angle + 2.0 * M_PI : std::max(angle, 0.0);
}

/// The goal at radius 1, with what every formula needs of it.
struct Target {
  double x, y, phi, sin, cos;

  Target timeFlipped() const { return {-x, y, -phi, -sin, cos}; }
  Target reflected() const { return {x, -y, -phi, -sin, cos}; }
  /// The goal of the same curve driven from its end to its begin, mirrored.
  Target backwards() const { return {x * cos + y * sin, x * sin - y * cos, phi, sin, cos}; }
};

Target targetOf(const Pose2d& from, const Pose2d& to, double radius) {
  const double c = std::cos(from.heading), s = std::sin(from.heading);
  const double dx = (to.x - from.x) / radius, dy = (to.y - from.y) / radius;
  const double phi = normalizeAngle(to.heading - from.heading);
  return {c * dx + s * dy, c * dy - s * dx, phi, std::sin(phi), std::cos(phi)};
}

/// Collects words; knows price and limit.
class Collector {
 public:
  Collector(const WordQuery& query, WordSet* words) : query_(query), words_(words) { words_->clear(); }

  /// Longest that a word with this many gear changes may be, at radius 1.
  double limit(int gear_changes) const {
    const double factor = std::min(query_.cost.forward_factor, query_.cost.reverse_factor);
    return (query_.max_cost - gear_changes * query_.cost.gear_change_cost) / (factor * query_.radius);
  }

  /// `flip` is -1 for a time flipped word, `mirror` is -1 for a reflected one.
  template <std::size_t kSize>
  void add(const std::array<Steer, kSize>& steer, const std::array<double, kSize>& lengths, int flip, int mirror) {
    SteeringWord word;
    const Junctions& junctions = query_.junctions;
    int gear = junctions.before, changes = 0;
    double cost = 0.0, kappa = junctions.kappa_before;
    for (std::size_t i = 0; i < kSize; ++i) {
      const double length = lengths[i] * flip * query_.radius;
      if (std::abs(length) < kEmptyArc) continue;
      const int now = length > 0.0 ? 1 : -1;
      const ArcSegment arc{length, steer[i] * mirror / query_.radius};
      if (gear == now) cost += query_.cost.ofSteering(kappa, arc.kappa);
      kappa = arc.kappa;
      changes += gear == -now;
      word.gear_changes += word.size > 0 && gear == -now;
      gear = now;
      word.length += std::abs(length);
      cost += query_.cost.ofArc(length);
      word.arcs[word.size++] = arc;
    }
    changes += gear != 0 && gear == -junctions.after;
    if (gear != 0 && gear == junctions.after) cost += query_.cost.ofSteering(kappa, junctions.kappa_after);
    word.cost = cost + changes * query_.cost.gear_change_cost;
    if (word.cost <= query_.max_cost && words_->size() < WordSet::kCapacity) words_->add(word);
  }

 private:
  const WordQuery& query_;
  WordSet* words_;
};

struct Lengths {
  double t, u, v;
};

// Each formula gives up early where the arcs it already knows are longer than `limit`.

/// 8.1: L+ S+ L+
bool leftStraightLeft(const Target& goal, double limit, Lengths* out) {
  const double a = goal.x - goal.sin, b = goal.y - 1.0 + goal.cos;
  out->u = std::sqrt(a * a + b * b);
  if (out->u > limit || b < -kZero - kSameCircle) return false;
  out->t = out->u < kSameCircle ? 0.0 : std::atan2(b, a);  // a single arc: its direction would be noise
  if (out->t < -kZero) return false;
  out->v = wrap(goal.phi - out->t);
  return out->v >= -kZero;
}

/// 8.2: L+ S+ R+
bool leftStraightRight(const Target& goal, double limit, Lengths* out) {
  const double a = goal.x + goal.sin, b = goal.y - 1.0 - goal.cos;
  const double squared = a * a + b * b;
  if (squared < 4.0 || squared - 4.0 > limit * limit) return false;
  out->u = std::sqrt(squared - 4.0);
  out->t = std::atan2(b * out->u + 2.0 * a, a * out->u - 2.0 * b);
  if (out->t < -kZero) return false;
  out->v = wrap(out->t - goal.phi);
  return out->v >= -kZero;
}

/// 8.3 and 8.4: L+ R- L+-
bool leftRightLeft(const Target& goal, double limit, Lengths* out) {
  const double a = goal.x - goal.sin, b = goal.y - 1.0 + goal.cos;
  const double squared = a * a + b * b;
  if (squared > std::min(16.0, 4.0 * limit * limit) || squared < kSameCircle * kSameCircle) return false;
  out->u = -2.0 * std::asin(0.25 * std::sqrt(squared));
  out->t = wrap(std::atan2(b, a) + 0.5 * out->u + M_PI);
  out->v = wrap(goal.phi - out->t + out->u);
  return out->t >= -kZero && out->u <= kZero;
}

void tauOmega(double u, double v, double xi, double eta, double phi, Lengths* out) {
  const double delta = u - v;
  const double a = std::sin(u) - std::sin(delta), b = std::cos(u) - std::cos(delta) - 1.0;
  const double t1 = std::atan2(eta * a - xi * b, xi * a + eta * b);
  const double t2 = 2.0 * (std::cos(delta) - std::cos(v) - std::cos(u)) + 3.0;
  out->t = t2 < 0.0 ? wrap(t1 + M_PI) : wrap(t1);
  out->v = wrap(out->t - u + v - phi);
}

/// 8.7: L+ R+ L- R-, the two in the middle equally long
bool leftRightThenBack(const Target& goal, double limit, Lengths* out) {
  const double xi = goal.x + goal.sin, eta = goal.y - 1.0 - goal.cos;
  const double rho = 0.25 * (2.0 + std::sqrt(xi * xi + eta * eta));
  if (rho > 1.0 || 8.0 * (1.0 - rho) > limit * limit) return false;  // acos(rho)^2 >= 2 (1 - rho)
  out->u = std::acos(rho);
  tauOmega(out->u, -out->u, xi, eta, goal.phi, out);
  return out->t >= -kZero && out->v <= kZero;
}

/// 8.8: L+ R- L- R+, the two in the middle equally long
bool leftBackRight(const Target& goal, double limit, Lengths* out) {
  const double xi = goal.x + goal.sin, eta = goal.y - 1.0 - goal.cos;
  const double rho = (20.0 - xi * xi - eta * eta) / 16.0;
  if (rho < 0.0 || rho > 1.0 || 8.0 * (1.0 - rho) > limit * limit) return false;
  out->u = -std::acos(rho);
  tauOmega(out->u, out->u, xi, eta, goal.phi, out);
  return out->t >= -kZero && out->v >= -kZero;
}

/// 8.9: L+ R-(pi/2) S- L-
bool leftQuarterStraightLeft(const Target& goal, double limit, Lengths* out) {
  const double xi = goal.x - goal.sin, eta = goal.y - 1.0 + goal.cos;
  const double squared = xi * xi + eta * eta;
  if (squared < 8.0) return false;
  const double r = std::sqrt(squared - 4.0);
  out->u = 2.0 - r;
  if (kHalfPi - out->u > limit) return false;
  out->t = std::atan2(-2.0 * eta + r * xi, -2.0 * xi - r * eta);
  if (out->t < -kZero) return false;
  out->v = wrap(goal.phi - kHalfPi - out->t);
  return out->v <= kZero;
}

/// 8.10: L+ R-(pi/2) S- R-
bool leftQuarterStraightRight(const Target& goal, double limit, Lengths* out) {
  const double xi = goal.x + goal.sin, eta = goal.y - 1.0 - goal.cos;
  const double squared = xi * xi + eta * eta;
  if (squared < 4.0 || xi < -kZero) return false;
  out->u = 2.0 - std::sqrt(squared);
  if (kHalfPi - out->u > limit) return false;
  out->t = std::atan2(xi, -eta);
  out->v = wrap(out->t + kHalfPi - goal.phi);
  return out->t >= -kZero && out->v <= kZero;
}

/// 8.11: L+ R-(pi/2) S- L-(pi/2) R+
bool leftQuarterStraightQuarterRight(const Target& goal, double limit, Lengths* out) {
  const double xi = goal.x + goal.sin, eta = goal.y - 1.0 - goal.cos;
  const double squared = xi * xi + eta * eta;
  if (squared < 20.0) return false;
  out->u = 4.0 - std::sqrt(squared - 4.0);
  if (M_PI - out->u > limit) return false;
  out->t = std::atan2((4.0 - out->u) * xi - 2.0 * eta, -2.0 * xi + (out->u - 4.0) * eta);
  if (out->t < -kZero) return false;
  out->v = wrap(out->t - goal.phi);
  return out->v >= -kZero;
}

/// The words whose first arc is left and forward, before time flip and reflection; and those read from the goal's end.
void addFamily(const Target& goal, int flip, int mirror, Collector* words) {
  Lengths l;
  const double smooth = words->limit(0), one_cusp = words->limit(1), two_cusps = words->limit(2);
  if (leftStraightLeft(goal, smooth, &l)) words->add<3>({kL, kS, kL}, {l.t, l.u, l.v}, flip, mirror);
  if (leftStraightRight(goal, smooth, &l)) words->add<3>({kL, kS, kR}, {l.t, l.u, l.v}, flip, mirror);
  if (one_cusp < 0.0) return;
  if (leftRightLeft(goal, one_cusp, &l)) words->add<3>({kL, kR, kL}, {l.t, l.u, l.v}, flip, mirror);
  if (leftRightThenBack(goal, one_cusp, &l)) words->add<4>({kL, kR, kL, kR}, {l.t, l.u, -l.u, l.v}, flip, mirror);
  if (leftQuarterStraightLeft(goal, one_cusp, &l)) {
    words->add<4>({kL, kR, kS, kL}, {l.t, -kHalfPi, l.u, l.v}, flip, mirror);
  }
  if (leftQuarterStraightRight(goal, one_cusp, &l)) {
    words->add<4>({kL, kR, kS, kR}, {l.t, -kHalfPi, l.u, l.v}, flip, mirror);
  }
  const Target back = goal.backwards();
  if (leftRightLeft(back, one_cusp, &l)) words->add<3>({kL, kR, kL}, {l.v, l.u, l.t}, flip, mirror);
  if (leftQuarterStraightLeft(back, one_cusp, &l)) {
    words->add<4>({kL, kS, kR, kL}, {l.v, l.u, -kHalfPi, l.t}, flip, mirror);
  }
  if (leftQuarterStraightRight(back, one_cusp, &l)) {
    words->add<4>({kR, kS, kR, kL}, {l.v, l.u, -kHalfPi, l.t}, flip, mirror);
  }
  if (two_cusps < 0.0) return;
  if (leftBackRight(goal, two_cusps, &l)) words->add<4>({kL, kR, kL, kR}, {l.t, l.u, l.u, l.v}, flip, mirror);
  if (leftQuarterStraightQuarterRight(goal, two_cusps, &l)) {
    words->add<5>({kL, kR, kS, kL, kR}, {l.t, -kHalfPi, l.u, -kHalfPi, l.v}, flip, mirror);
  }
}

/// Dubins words that begin with a left arc.
void addDubinsFamily(const Target& goal, int mirror, Collector* words) {
  {
    const double a = goal.x - goal.sin, b = goal.y - 1.0 + goal.cos;
    const double t = wrapPositive(std::atan2(b, a));
    words->add<3>({kL, kS, kL}, {t, std::hypot(a, b), wrapPositive(goal.phi - t)}, 1, mirror);
  }
  {
    const double a = goal.x + goal.sin, b = goal.y - 1.0 - goal.cos;
    const double squared = a * a + b * b;
    if (squared >= 4.0) {
      const double u = std::sqrt(squared - 4.0);
      const double t = wrapPositive(std::atan2(b, a) + std::atan2(2.0, u));
      words->add<3>({kL, kS, kR}, {t, u, wrapPositive(t - goal.phi)}, 1, mirror);
    }
  }
  {
    // The middle arc turns by more than pi around the centre that lies to the right of both outer circles.
    const double a = goal.x - goal.sin, b = goal.y - 1.0 + goal.cos;
    const double squared = a * a + b * b;
    if (squared <= 16.0) {
      const double u = 2.0 * M_PI - 2.0 * std::asin(0.25 * std::sqrt(squared));
      const double t = wrapPositive(std::atan2(b, a) + 0.5 * u);
      words->add<3>({kL, kR, kL}, {t, u, wrapPositive(goal.phi - t + u)}, 1, mirror);
    }
  }
}

}  // namespace

SteeringWord WordSet::takeCheapest() {
  int best = 0;
  for (int i = 1; i < size_; ++i) {
    if (words_[i].cost < words_[best].cost) best = i;
  }
  const SteeringWord word = words_[best];
  words_[best] = words_[--size_];
  return word;
}

void reedsSheppWords(const Pose2d& from, const Pose2d& to, const WordQuery& query, WordSet* words) {
  Collector collector(query, words);
  const Target goal = targetOf(from, to, query.radius);
  addFamily(goal, 1, 1, &collector);
  addFamily(goal.timeFlipped(), -1, 1, &collector);
  addFamily(goal.reflected(), 1, -1, &collector);
  addFamily(goal.timeFlipped().reflected(), -1, -1, &collector);
}

void dubinsWords(const Pose2d& from, const Pose2d& to, const WordQuery& query, WordSet* words) {
  Collector collector(query, words);
  const Target goal = targetOf(from, to, query.radius);
  addDubinsFamily(goal, 1, &collector);
  addDubinsFamily(goal.reflected(), -1, &collector);
}

}  // namespace external_command
