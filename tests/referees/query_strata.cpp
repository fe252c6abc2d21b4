#include "tests/referees/query_strata.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <mutex>
#include <numbers>
#include <optional>

#include "engine/query/separation.h"
#include "tests/referees/separation_kinds.h"

namespace vex {
namespace {

using Random = std::mt19937_64;

// Bodies are made once: a hull is dear.
const ConvexBody& body_of(const std::string& text) {
  static std::mutex making;
  static std::map<std::string, ConvexBody> made;
  const std::lock_guard lock(making);
  const auto found = made.find(text);
  return found != made.end() ? found->second : made.emplace(text, separation_body(text)).first->second;
}

template <class Texts>
std::string one_of(const Texts& texts, Random& random) {
  return texts[random() % texts.size()];
}

std::string length_text(double x) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.17g", x);
  return text.data();
}

std::string vector_text(const Vec3d& v) {
  std::array<char, 96> text;
  std::snprintf(text.data(), text.size(), "%a,%a,%a", v.x, v.y, v.z);
  return text.data();
}

QueryScene scene_of(const std::string& a, const std::string& b) {
  return {a, b, body_of(a), body_of(b), {}, {}, {}, HUGE_VAL};
}

// Texts are drawn one after the other, and so are all numbers: which argument of a call is evaluated first is the
// compiler's choice, and every compiler shall make the same scenes.
template <class Text>
QueryScene scene_of_two(const Text& text) {
  const std::string b = text(), a = text();
  return scene_of(a, b);
}

// Two to the power of one of n whole numbers, from the least one up.
double random_power(Random& random, int least, std::uint64_t n) {
  return std::ldexp(1.0, least + static_cast<int>(random() % n));
}

double size_of_scene(const QueryScene& scene) { return scene.a.circumradius() + scene.b.circumradius(); }
Vec3d between_centres(const QueryScene& scene) { return scene.pose(scene.b.centre()) - scene.a.centre(); }

// Every body of the test list, hulls, bars and needles.
std::string ordinary_text(Random& random) {
  constexpr std::array kMore = {"hull:20", "hull:100", "ellipsoid:1,1,1e-3", "capsule:100,0.01", "box:0.01,0.01,3"};
  const std::size_t k = random() % (kTestBodies.size() + kMore.size());
  return k < kTestBodies.size() ? kTestBodies[k] : kMore[k - kTestBodies.size()];
}

void move_somewhere(QueryScene& scene, Random& random, int k) {
  Vec3d dir = random_direction(random);
  // Nearly always missed, were it not aimed.
  if (k % 3 != 0) dir = 0.3 * dir - (1.0 / size_of_scene(scene)) * between_centres(scene);
  scene.motion.velocity = size_of_scene(scene) * dir;
  const double spin = random_power(random, -3, 6);
  scene.motion.angular_velocity = spin * random_direction(random);
  if (k % 11 == 5) scene.motion.velocity = {};
}

QueryScene ordinary(Random& random, int k) {
  QueryScene scene = scene_of_two([&] { return ordinary_text(random); });
  scene.pose = random_pose(random, ball_domain(scene.a, scene.b), scene.b);
  move_somewhere(scene, random, k);
  return scene;
}

QueryScene thin(Random& random, int k) {
  constexpr std::array kFlat = {"plate:1,1", "plate:2,0.5", "disc:0.7", "needle:2"};
  const auto text = [&] {
    const double thickness = std::ldexp(1.0, -1 - static_cast<int>(random() % 50));
    switch (random() % 5) {
      case 0: return std::string("box:1,1,") + length_text(thickness);
      case 1: return "box:" + length_text(thickness) + "," + length_text(thickness) + ",2";
      case 2: return std::string("ellipsoid:1,1,") + length_text(thickness);
      default: return one_of(kFlat, random);
    }
  };
  const std::string a = text(), b = text();
  QueryScene scene{a, b, separation_body(a), separation_body(b), {}, {}, {}, HUGE_VAL};
  if (k % 2 == 0) {
    scene.pose = random_pose(random, ball_domain(scene.a, scene.b), scene.b);
  } else {
    scene.pose = aligned_pose(scene.a, scene.b, random, k);
    // Beside each other by next to nothing.
    const int exponent = -10 - static_cast<int>(random() % 45);
    scene.pose.translation.z += std::ldexp(random_in_unit_interval(random) - 0.5, exponent);
  }
  move_somewhere(scene, random, k);
  if (k % 4 == 1) scene.motion.velocity = {0.0, 0.0, k % 8 == 1 ? 1.0 : -1.0};
  if (k % 4 == 3) scene.motion.velocity.z = 0.0;
  return scene;
}

QueryScene touching(Random& random, int k) {
  QueryScene scene = scene_of_two([&] { return ordinary_text(random); });
  scene.pose =
      k % 2 == 0 ? near_contact_pose(scene.a, scene.b, random, k / 2) : aligned_pose(scene.a, scene.b, random, k);
  move_somewhere(scene, random, k);
  return scene;
}

// Near contact, and a motion away from it, or along the plane between the bodies, or hardly towards it.
QueryScene leaving(Random& random, int k) {
  QueryScene scene = touching(random, k);
  const Separation found = signed_distance(scene.a, scene.b, scene.pose);
  Vec3d normal = found.normal;
  if (!(norm_1(normal) > 0.0)) normal = {0.0, 0.0, 1.0};
  const Vec3d aside = cross(normal, random_direction(random));
  const double away = std::ldexp(1.0, -static_cast<int>(random() % 55));
  switch (k % 4) {
    case 0: scene.motion.velocity = normal; break;
    case 1: scene.motion.velocity = aside + away * normal; break;
    case 2: scene.motion.velocity = aside; break;
    default: scene.motion.velocity = aside - away * normal; break;
  }
  return scene;
}

// From afar, along the plane of a contact: past it by next to nothing on either side.
QueryScene grazing(Random& random, int k) {
  QueryScene scene = scene_of_two([&] { return ordinary_text(random); });
  scene.pose = random_contact_line(scene.a, scene.b, random).turn;
  const ContactLine line = random_contact_line(scene.a, scene.b, random);
  scene.pose = line.at(scene.a, scene.b, line.contact);
  const Separation found = signed_distance(scene.a, scene.b, scene.pose);
  const Vec3d normal = norm_1(found.normal) > 0.0 ? found.normal : Vec3d{0.0, 0.0, 1.0};
  const Vec3d aside = cross(normal, random_direction(random));
  const double off = (k % 2 == 0 ? 1.0 : -1.0) * std::ldexp(size_of_scene(scene), -4 - static_cast<int>(random() % 48));
  scene.pose.translation = scene.pose.translation + (off * normal - (3.0 * size_of_scene(scene) / norm(aside)) * aside);
  scene.motion.velocity = aside;
  const Vec3d axis = random_direction(random);
  scene.motion.angular_velocity = std::ldexp(1.0, -static_cast<int>(random() % 30)) * axis;
  return scene;
}

QueryScene parallel(Random& random, int k) {
  QueryScene scene = scene_of_two([&] { return ordinary_text(random); });
  scene.pose = aligned_pose(scene.a, scene.b, random, k);
  constexpr std::array<Vec3d, 6> kAxes = {
      {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, 0.0, -1.0}}};
  scene.motion.velocity = kAxes[random() % 6];
  const Vec3d axis = kAxes[random() % 6];
  scene.motion.angular_velocity = random_power(random, -2, 4) * axis;
  return scene;
}

QueryScene coaxial(Random& random, int k) {
  constexpr std::array kRound = {"cylinder:1,0.5", "cone:1,0.5",     "cone:0.2,1",        "disc:0.7",
                                 "capsule:1,0.25", "hemisphere:0.8", "frustum:1,0.7,0.3", "ellipsoid:0.5,0.5,1.5",
                                 "needle:2",       "sphere:0.6"};
  QueryScene scene = scene_of_two([&] { return one_of(kRound, random); });
  const ContactLine line(scene.a, scene.b, {}, {0.0, 0.0, k % 2 == 0 ? 1.0 : -1.0});
  scene.pose = k % 3 == 0 ? line.at(scene.a, scene.b, 2.0 * random_in_unit_interval(random) * line.contact)
                          : beside_contact(scene.a, scene.b, line, k);
  const double off = k % 5 == 0 ? std::ldexp(1.0, -10 - static_cast<int>(random() % 45)) : 0.0;
  scene.pose.translation.x += off;
  scene.motion.velocity = {k % 7 == 3 ? 1.0 : 0.0, 0.0, random() % 2 == 0 ? 1.0 : -1.0};
  scene.motion.angular_velocity = {k % 4 == 1 ? 1.0 : 0.0, 0.0, k % 4 == 2 ? 1.0 : 0.0};
  if (k % 4 == 0) scene.motion.angular_velocity = random_direction(random);
  return scene;
}

QueryScene far(Random& random, int k) {
  QueryScene scene = ordinary(random, k);
  const double away = std::ldexp(size_of_scene(scene), 5 + static_cast<int>(random() % 35));
  const Vec3d dir = random_direction(random);
  scene.pose.translation = scene.pose.translation + away * dir;
  scene.motion.velocity =
      (k % 3 == 0 ? 1.0 : -1.0) * (away * dir + (0.3 * size_of_scene(scene)) * random_direction(random));
  return scene;
}

// Both bodies tiny or huge, or one of them.
QueryScene sizes(Random& random, int k) {
  const int exponent = static_cast<int>(random() % 77) - 38;
  const double scale_a = std::pow(10.0, exponent);
  const double scale_b = k % 3 == 0 ? scale_a * std::pow(10.0, static_cast<int>(random() % 13) - 6) : scale_a;
  const std::string a = one_of(kTestBodies, random), b = one_of(kTestBodies, random);
  QueryScene scene{a + " * 1e" + std::to_string(exponent),
                   b + " * " + length_text(scale_b),
                   separation_body(a, scale_a),
                   separation_body(b, scale_b),
                   {},
                   {},
                   {},
                   HUGE_VAL};
  scene.pose = k % 2 == 0 ? random_pose(random, ball_domain(scene.a, scene.b), scene.b)
                          : near_contact_pose(scene.a, scene.b, random, k / 2);
  move_somewhere(scene, random, k);
  return scene;
}

// Many turns on the way, and motions of any unit of time.
QueryScene fast(Random& random, int k) {
  QueryScene scene = ordinary(random, k);
  const Vec3d axis = random_direction(random);
  scene.motion.angular_velocity = random_power(random, 2, 6) * axis;
  const double unit = k % 3 == 0 ? std::ldexp(1.0, static_cast<int>(random() % 1200) - 600) : 1.0;
  scene.motion.velocity = unit * scene.motion.velocity;
  scene.motion.angular_velocity = unit * scene.motion.angular_velocity;
  return scene;
}

QueryScene hulls(Random& random, int k) {
  constexpr std::array kHulls = {"hull:300", "hull:1000"};
  const std::string b = k % 2 == 0 ? one_of(kHulls, random) : ordinary_text(random), a = one_of(kHulls, random);
  QueryScene scene = scene_of(a, b);
  scene.pose = k % 3 == 0 ? near_contact_pose(scene.a, scene.b, random, k / 3)
                          : random_pose(random, ball_domain(scene.a, scene.b), scene.b);
  move_somewhere(scene, random, k);
  return scene;
}

// A box, a prism or points on a sphere, turned or not.
std::vector<Vec3d> solid_points(Random& random) {
  std::vector<Vec3d> points;
  const std::uint64_t kind = random() % 3;
  if (kind == 0) points = box_vertices(1.0, 0.5 + random_in_unit_interval(random), 1.0);
  const int n = 3 + static_cast<int>(random() % 20);
  for (int k = 0; kind == 1 && k < n; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / n;
    for (const double z : {-0.4, 0.4}) points.push_back({0.7 * std::cos(angle), 0.7 * std::sin(angle), z});
  }
  for (int k = 0; kind == 2 && k < 20 + 4 * n; ++k) {
    const Vec3d d = random_direction(random);
    points.push_back((0.8 / norm(d)) * d);
  }
  const Transformd turn = random() % 2 == 0 ? random_rotation(random) : Transformd{};
  for (Vec3d& p : points) p = turn(p);
  return points;
}

// Polytopes of size 1 so far from the origins of their own frames that coordinates hardly tell their corners apart; the
// pose brings them together.
QueryScene displaced(Random& random, int k) {
  const double far = std::pow(10.0, static_cast<int>(random() % 11) + 3);
  const auto body = [&](std::string& text) {
    const Vec3d middle = far * random_direction(random);
    std::vector<Vec3d> vertices = solid_points(random);
    for (Vec3d& v : vertices) v = v + middle;
    text = std::to_string(vertices.size()) + " points about " + vector_text(middle);
    return ConvexBody(Polytope(vertices, middle, 0.0));
  };
  std::string a_text, b_text;
  const ConvexBody a = body(a_text), b = body(b_text);
  QueryScene scene{a_text, b_text, a, b, {}, {}, {}, HUGE_VAL};
  switch (k % 3) {
    case 0: {
      const Vec3d dir = random_direction(random);
      put_centres_apart(a, b, (2.0 * random_in_unit_interval(random)) * dir, scene.pose);
      break;
    }
    case 1: scene.pose = near_contact_pose(a, b, random, k / 3); break;
    default: scene.pose = aligned_pose(a, b, random, k); break;
  }
  move_somewhere(scene, random, k);
  return scene;
}

// Every fourth motion has an end, before or after what may happen; of every third pair A moves as well, and B moves as
// is said beside that.
using MakeScene = QueryScene (*)(Random& random, int k);
template <MakeScene make>
QueryScene with_ends(Random& random, int k) {
  QueryScene scene = make(random, k);
  const double speed = safe_norm(scene.motion.velocity), spin = safe_norm(scene.motion.angular_velocity);
  if (k % 4 == 2) {
    const double way = safe_norm(between_centres(scene)) + size_of_scene(scene);
    scene.until = 2.0 * random_in_unit_interval(random) * (speed > 0.0 ? way / speed : 7.0 / spin);
  }
  if (k % 3 == 1) {
    scene.motion_a.velocity = speed * random_direction(random);
    // It may turn with B, against it, or neither.
    scene.motion_a.angular_velocity = k % 2 == 0 ? spin * random_direction(random) : scene.motion.angular_velocity;
    if (k % 5 == 0) scene.motion_a.angular_velocity = {};
  }
  return scene;
}

}  // namespace

std::string QueryScene::text() const {
  return "'" + a_text + "' '" + b_text + "' --matrix " + vector_text(pose.row_x) + "," + vector_text(pose.row_y) + "," +
         vector_text(pose.row_z) + "," + vector_text(pose.translation) + " velocity " + vector_text(motion.velocity) +
         " radians " + vector_text(motion.angular_velocity) + " A's " + vector_text(motion_a.velocity) + "," +
         vector_text(motion_a.angular_velocity) + " until " + length_text(until);
}

const std::vector<QueryStratum>& query_strata() {
  static const std::vector<QueryStratum> strata = {
      {"ordinary", with_ends<ordinary>}, {"thin", with_ends<thin>},       {"touching", with_ends<touching>},
      {"leaving", with_ends<leaving>},   {"grazing", with_ends<grazing>}, {"parallel", with_ends<parallel>},
      {"coaxial", with_ends<coaxial>},   {"far", with_ends<far>},         {"sizes", with_ends<sizes>},
      {"fast", with_ends<fast>},         {"hulls", with_ends<hulls>},     {"displaced", with_ends<displaced>}};
  return strata;
}

}  // namespace vex
