// Overlaps and first contacts over arrays of poses.
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "engine/query/cast_of_many.h"
#include "engine/query/contact_certificate.h"
#include "engine/query/first_contact.h"
#include "engine/query/margin.h"
#include "engine/query/overlap.h"
#include "engine/query/overlap_backend.h"
#include "engine/query/packets/packet_overlap.h"
#include "engine/support/point_body.h"
#include "python/bindings/body.h"
#include "python/bindings/proofs.h"

namespace vex::python {
namespace {

using Verdicts = py::array_t<std::int8_t>;

struct ContactRow {
  double time, lower, upper;
  double normal[3], point_a[3], point_b[3];
  std::int8_t verdict;
};
/// Blocks of the backend's own size, so that packets are full.
constexpr std::size_t kPosesABlock = PacketOverlap::kMostTrials;

Verdicts overlap_of_poses(const PyBody& a, const PyBody& b, const Floats& rows,
                          const std::optional<Floats>& translations, int threads) {
  const PoseRows poses(rows, translations);
  Verdicts verdicts(static_cast<py::ssize_t>(poses.size()));
  std::int8_t* const to = verdicts.mutable_data();
  const BackendKind gjk = gjk_backend();
  const auto n_threads = static_cast<std::size_t>(number_of_threads(threads));
  over_rows(poses.size(), threads, kPosesABlock, [&] {
    return [&, backend = std::shared_ptr<OverlapBackend>(gjk.make(a.body, b.body))](std::size_t first,
                                                                                    std::size_t last) {
      alignas(64) double columns[kPoseColumns][PacketOverlap::kStride];
      std::array<Verdict, kPosesABlock> answers;
      poses.set_columns(first, last, columns[0]);
      poses.prefetch_rows(first + kPosesABlock * n_threads, last + kPosesABlock * n_threads);
      backend->decide_table({columns[0], PacketOverlap::kStride, last - first}, std::span(answers).first(last - first));
      for (std::size_t k = first; k < last; ++k) to[k] = number_of(answers[k - first].outcome);
    };
  });
  return verdicts;
}

py::tuple certified_overlap_of_poses(const PyBody& a, const PyBody& b, const Floats& rows,
                                     const std::optional<Floats>& translations, int threads) {
  const PoseRows poses(rows, translations);
  Verdicts verdicts(static_cast<py::ssize_t>(poses.size()));
  std::int8_t* const to = verdicts.mutable_data();
  Proofs proofs(true, poses.size());
  over_each_pose(poses, threads, [&](std::size_t k, const Pose& pose) {
    OverlapCertificate certificate;
    const Outcome outcome = overlap(a.body, b.body, pose, &certificate).outcome;
    to[k] = number_of(outcome);
    proofs.set(k, outcome == Outcome::undecided
                      ? CertificateCheck{false, "undecided"}
                      : check_certificate(a.body, b.body, pose.a_from_b(), outcome, certificate));
  });
  return py::make_tuple(verdicts, proofs.arrays());
}

Verdicts within_of_poses(const PyBody& a, const PyBody& b, const Floats& rows,
                         const std::optional<Floats>& translations, double margin, int threads) {
  if (!(margin >= 0.0) || !std::isfinite(margin)) {
    throw UsageError("a margin is a finite length from 0 up - give one");
  }
  const PoseRows poses(rows, translations);
  Verdicts verdicts(static_cast<py::ssize_t>(poses.size()));
  std::int8_t* const to = verdicts.mutable_data();
  const MarginPairs pairs(a.body, b.body, margin);
  over_each_pose(poses, threads,
                 [&](std::size_t k, const Pose& pose) { to[k] = number_of(within_margin(pairs, pose).outcome); });
  return verdicts;
}

ContactRow row_of(const FirstContact& found) {
  ContactRow row{};
  row.verdict = number_of(found.verdict.outcome);
  row.time = found.time;
  row.lower = found.lower;
  row.upper = found.upper;
  if (found.verdict.outcome == Outcome::overlap) {
    put(row.normal, found.normal);
    put(row.point_a, found.point_a);
    put(row.point_b, found.point_b);
  } else {
    for (double* const to : {row.normal, row.point_a, row.point_b}) put_nan(to);
    if (found.verdict.outcome == Outcome::undecided) row.time = kNan;
  }
  return row;
}

void require_as_many(std::size_t n, std::size_t n_poses, const char* what) {
  if (n != n_poses) {
    throw UsageError(std::string("not as many ") + what + " (" + std::to_string(n) + ") as poses or origins (" +
                     std::to_string(n_poses) + ") - give one each");
  }
}

/// answer(first, last, found), one for each thread, writes the answers of a block of rows; prove(k, found) is what the
/// checker says to a row's certificate.
template <class MakeAnswer, class Prove>
py::tuple first_contacts(std::size_t n, bool certify_answers, int threads, const MakeAnswer& make_answer,
                         const Prove& prove) {
  py::array_t<ContactRow> result(static_cast<py::ssize_t>(n));
  ContactRow* const to = result.mutable_data();
  Proofs proofs(certify_answers, n);
  const std::size_t block = certify_answers ? kRowsABlock : kPosesABlock;
  over_rows(n, threads, block, [&] {
    return [&, answer = make_answer(), found = std::vector<FirstContact>(block)](std::size_t first,
                                                                                 std::size_t last) mutable {
      answer(first, last, std::span(found).first(last - first));
      for (std::size_t k = first; k < last; ++k) {
        to[k] = row_of(found[k - first]);
        if (proofs.is_wanted()) proofs.set(k, prove(k, found[k - first]));
      }
    };
  });
  return py::make_tuple(result, proofs.arrays());
}

/// Of B moving by by[k]; set_columns(first, last, columns) has it in pose k at the start.
template <class SetColumns>
auto make_casts(const ConvexBody& a, const ConvexBody& b, const SetColumns& set_columns, const Rows3& by,
                double until) {
  return [&a, &b, &set_columns, &by, until] {
    return [&set_columns, &by, many = std::make_shared<ManyCasts>(a, b, until)](std::size_t first, std::size_t last,
                                                                                std::span<FirstContact> found) {
      alignas(64) double columns[kPoseColumns][PacketOverlap::kStride];
      std::array<Vec3d, kPosesABlock> motions;
      set_columns(first, last, columns[0]);
      for (std::size_t k = first; k < last; ++k) motions[k - first] = by[k];
      many->answer({columns[0], PacketOverlap::kStride, last - first}, motions, found);
    };
  };
}

py::tuple rays(const PyBody& a, const Floats& origins, const Floats& dirs, double until, bool certify_answers,
               int threads) {
  const Rows3 from(origins), along(dirs);
  require_as_many(along.size(), from.size(), "directions");
  const auto set_columns = [&](std::size_t first, std::size_t last, double* columns) {
    for (std::size_t k = first; k < last; ++k) {
      set_pose(columns, PacketOverlap::kStride, k - first, Pose(start_of_ray(from[k])).a_from_b());
    }
  };
  return first_contacts(from.size(), certify_answers, threads,
                        make_casts(a.body, point_of_ray(), set_columns, along, until),
                        [&](std::size_t k, const FirstContact& found) {
                          const ContactCertificate certificate = certify_ray(a.body, from[k], along[k], found, until);
                          return check_ray_certificate(a.body, from[k], along[k], found, certificate, until);
                        });
}

py::tuple casts(const PyBody& a, const PyBody& b, const Floats& rows, const std::optional<Floats>& translations,
                const Floats& motions, double until, bool certify_answers, int threads) {
  const PoseRows poses(rows, translations);
  const Rows3 by(motions);
  require_as_many(by.size(), poses.size(), "motions");
  const auto set_columns = [&](std::size_t first, std::size_t last, double* columns) {
    poses.set_columns(first, last, columns);
  };
  return first_contacts(poses.size(), certify_answers, threads, make_casts(a.body, b.body, set_columns, by, until),
                        [&](std::size_t k, const FirstContact& found) {
                          const ContactCertificate certificate = certify(a.body, b.body, poses[k], by[k], found, until);
                          return check_certificate(a.body, b.body, poses[k], by[k], found, certificate, until);
                        });
}

py::tuple impacts(const PyBody& a, const PyBody& b, const Floats& rows, const std::optional<Floats>& translations,
                  const Floats& velocities, const Floats& angular_velocities, const std::optional<Floats>& velocities_a,
                  const std::optional<Floats>& angular_velocities_a, double until, bool certify_answers, int threads) {
  const PoseRows poses(rows, translations);
  const Rows3 v(velocities), w(angular_velocities);
  std::optional<Rows3> v_a, w_a;
  if (velocities_a) v_a.emplace(*velocities_a);
  if (angular_velocities_a) w_a.emplace(*angular_velocities_a);
  for (const Rows3* const each : {&v, &w, v_a ? &*v_a : &v, w_a ? &*w_a : &w}) {
    require_as_many(each->size(), poses.size(), "velocities");
  }
  const bool a_moves = v_a || w_a;
  const auto motion_a = [&](std::size_t k) {
    return RigidMotion{v_a ? (*v_a)[k] : Vec3d{}, w_a ? (*w_a)[k] : Vec3d{}};
  };
  const auto motion_b = [&](std::size_t k) { return RigidMotion{v[k], w[k]}; };
  const auto impact = [&](std::size_t k) {
    return a_moves ? time_of_impact(a.body, b.body, poses[k], motion_a(k), motion_b(k), until)
                   : time_of_impact(a.body, b.body, poses[k], motion_b(k), until);
  };
  return first_contacts(
      poses.size(), certify_answers, threads,
      [&] {
        return [&](std::size_t first, std::size_t last, std::span<FirstContact> found) {
          for (std::size_t k = first; k < last; ++k) found[k - first] = impact(k);
        };
      },
      [&](std::size_t k, const FirstContact& found) {
        const Pose pose = poses[k];
        if (a_moves) {
          const ContactCertificate certificate = certify(a.body, b.body, pose, motion_a(k), motion_b(k), found, until);
          return check_certificate(a.body, b.body, pose, motion_a(k), motion_b(k), found, certificate, until);
        }
        const ContactCertificate certificate = certify(a.body, b.body, pose, motion_b(k), found, until);
        return check_certificate(a.body, b.body, pose, motion_b(k), found, certificate, until);
      });
}

/// What proves a verdict, for whoever wants to prove it with a checker of his own (certificate.h).
py::dict overlap_certificate(const PyBody& a, const PyBody& b, const Floats& rows,
                             const std::optional<Floats>& translations) {
  const PoseRows poses(rows, translations);
  if (poses.size() != 1) throw UsageError("a certificate is of one pose - give one");
  const Pose pose = poses[0];
  OverlapCertificate certificate;
  Verdict verdict;
  CertificateCheck check{false, "undecided"};
  {
    const WithoutGil without_gil;
    verdict = overlap(a.body, b.body, pose, &certificate);
    if (verdict.outcome != Outcome::undecided) {
      check = check_certificate(a.body, b.body, pose.a_from_b(), verdict.outcome, certificate);
    }
  }
  const auto triple = [](const Vec3d& v) { return py::make_tuple(v.x, v.y, v.z); };
  py::list witnesses;
  for (int k = 0; k < certificate.n_witnesses; ++k) {
    const Witness& witness = certificate.witnesses[static_cast<std::size_t>(k)];
    py::dict dict;
    dict["dir"] = triple(witness.dir);
    dict["dir_low"] = triple(witness.dir_low);
    dict["dir_b"] = triple(witness.dir_b);
    dict["dir_b_low"] = triple(witness.dir_b_low);
    dict["point_a"] = triple(witness.point_a);
    dict["point_b"] = triple(witness.point_b);
    witnesses.append(dict);
  }
  py::dict dict;
  dict["verdict"] = std::string(name_of(verdict.outcome));
  dict["decided_by"] = std::string(name_of(verdict.by));
  dict["is_proven"] = check.is_proven;
  dict["fault"] = check.fault;
  dict["separating_dir"] = triple(certificate.separating_dir);
  dict["separating_dir_low"] = triple(certificate.separating_dir_low);
  dict["witnesses"] = witnesses;
  dict["gap_lower"] = certificate.gap_lower;
  dict["gap_upper"] = certificate.gap_upper;
  return dict;
}

}  // namespace

void bind_queries(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(ContactRow, time, lower, upper, normal, point_a, point_b, verdict);

  const auto a = py::arg("a"), b = py::arg("b"), poses = py::arg("poses"), threads = py::arg("threads"),
             certify = py::arg("certify"), until = py::arg("until");
  const auto translations = py::arg("translations").none(true);
  module.def("overlap", &overlap_of_poses, a, b, poses, translations, threads);
  module.def("certified_overlap", &certified_overlap_of_poses, a, b, poses, translations, threads);
  module.def("overlap_certificate", &overlap_certificate, a, b, poses, translations);
  module.def("within", &within_of_poses, a, b, poses, translations, py::arg("margin"), threads);
  module.def("ray_cast", &rays, a, py::arg("origins"), py::arg("directions"), until, certify, threads);
  module.def("linear_cast", &casts, a, b, poses, translations, py::arg("motions"), until, certify, threads);
  module.def("time_of_impact", &impacts, a, b, poses, translations, py::arg("velocities"),
             py::arg("angular_velocities"), py::arg("velocities_a").none(true),
             py::arg("angular_velocities_a").none(true), until, certify, threads);
}

}  // namespace vex::python
