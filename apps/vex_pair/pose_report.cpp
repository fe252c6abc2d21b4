#include <cmath>

#include "apps/common/body_report.h"
#include "apps/common/numbers.h"
#include "apps/common/text.h"
#include "apps/vex_pair/report.h"

namespace vex {
namespace {

std::string in_words(DecidedBy by) {
  switch (by) {
    case DecidedBy::outer_bound: return "the circumscribed balls, which do not meet";
    case DecidedBy::inner_bound: return "the inscribed balls, which meet";
    case DecidedBy::gjk: return "GJK in double precision, with its rounding errors bounded";
    case DecidedBy::double_double: return "GJK in twice the precision, with its rounding errors bounded";
    case DecidedBy::exact: return "exact arithmetic";
    case DecidedBy::peer: break;
  }
  return "another library";
}

std::string vector_text(const Vec3d& v) {
  return "(" + shortest_number(v.x) + ", " + shortest_number(v.y) + ", " + shortest_number(v.z) + ")";
}

std::string line(const std::string& name, const std::string& value) {
  return "   " + name + std::string(34 - name.size(), ' ') + value + "\n";
}

std::string check_text(const Answer& answer) {
  if (!answer.check) return "";
  return line("proven again from these",
              answer.check->is_proven ? "yes, in exact arithmetic" : "no: " + answer.check->fault);
}

std::string certificate_text(Query query, const Answer& answer) {
  if (query != Query::overlap) {
    return line("certificate", certificate_summary(answer.query_certificate)) + check_text(answer);
  }
  if (answer.is_undecided()) return line("certificate", "none: nothing is proven");
  const OverlapCertificate& certificate = answer.certificate;
  std::string text;
  if (answer.verdict.outcome == Outcome::disjoint) {
    text += line("separating direction", vector_text(certificate.separating_dir));
    text += line("   and what doubles left of it", vector_text(certificate.separating_dir_low));
  }
  for (int k = 0; k < certificate.n_witnesses; ++k) {
    const Witness& witness = certificate.witnesses[static_cast<std::size_t>(k)];
    text += line("witness " + std::to_string(k) + ": direction", vector_text(witness.dir));
    text += line("   and what doubles left of it", vector_text(witness.dir_low));
    text += line("   point of A", vector_text(witness.point_a));
    text += line("   point of B, in B's frame", vector_text(witness.point_b));
  }
  return text + check_text(answer);
}

std::string end_text(const QuerySettings& asked) {
  return asked.until < HUGE_VAL ? " until " + shortest_number(asked.until) : "";
}

// Of A and B, in capitals what was found.
std::string headline(const PairRun& run) {
  const Answer& answer = *run.one;
  const QuerySettings& asked = run.options.query;
  const std::string a = "A " + printable(run.a.source), b = "B " + printable(run.b.source);
  const bool found = answer.verdict.outcome == Outcome::overlap;
  if (asked.query == Query::ray) {
    if (answer.is_undecided()) return "UNDECIDED whether the ray hits " + a + " or " + b;
    if (!found) return "The ray MISSES " + a + " and " + b + end_text(asked);
    const bool at_start = answer.is_at_start();
    if (answer.ray_hit == Answer::RayHit::either) {
      if (at_start) return "The ray HITS " + a + " or " + b + ": it starts in one of them, or in both";
      return "The ray HITS " + a + " or " + b + ": which one first is within rounding";
    }
    return "The ray HITS " + (answer.ray_hit == Answer::RayHit::a ? a : b) + (at_start ? ", in which it starts" : "");
  }
  if (is_of_motion(asked.query)) {
    if (answer.is_undecided()) return "UNDECIDED whether " + b + " meets " + a;
    if (!found) return b + (asked.until < HUGE_VAL ? " DOES NOT MEET " : " NEVER MEETS ") + a + end_text(asked);
    return b + " MEETS " + a + (answer.is_at_start() ? " at the start: they share a point before it moves" : "");
  }
  const bool with_margin = asked.query == Query::overlap && asked.margin > 0.0;
  const std::string pair = a + " and " + b + (with_margin ? ", with a margin of " + shortest_number(asked.margin) : "");
  if (answer.is_undecided()) return pair + ": UNDECIDED";
  if (with_margin) {
    return pair + (found ? ", OVERLAP: their gap is not larger" : ", are DISJOINT: their gap is larger");
  }
  return pair + (found ? " OVERLAP: they share a point" : " are DISJOINT: they share no point");
}

std::string why_undecided(const QuerySettings& asked, const Answer& answer) {
  if (answer.verdict.reason != UndecidedReason::rounding) return "the search was given up";
  if (asked.query == Query::overlap && asked.margin > 0.0) {
    return "their gap is the margin to within rounding: that it is larger is not proven, nor that it is not";
  }
  return is_of_motion(asked.query)
             ? "it grazes: a move by no more than rounding would make it hit, or miss"
             : "a move by no more than rounding would part them, or make them meet: neither is proven";
}

std::string bound_text(double value) { return std::isfinite(value) ? shortest_number(value) : "unknown"; }

std::string value_text(Query query, const Answer& answer) {
  if (query == Query::overlap) {
    if (!answer.is_undecided()) return "";
    return line("gap (negative: depth), from below", bound_text(answer.lower)) +
           line("   from above", bound_text(answer.upper));
  }
  if (is_of_motion(query) && answer.verdict.outcome != Outcome::overlap) {
    return answer.is_undecided() ? line("a contact, if any, not before", bound_text(answer.lower)) : "";
  }
  if (is_of_motion(query) && answer.is_at_start()) return line(std::string(name_of_value(query, answer)), "0, exactly");
  return line(std::string(name_of_value(query, answer)), bound_text(answer.value)) +
         line("   between", bound_text(answer.lower) + " and " + bound_text(answer.upper) +
                                (answer.is_rough ? ", rough: the search ended before they were near" : ""));
}

std::string witness_text(Query query, const Answer& answer) {
  std::string text;
  if (answer.normal) {
    text +=
        line(query == Query::ray ? "normal, out of the body" : "normal, from A towards B", vector_text(*answer.normal));
  }
  if (answer.point_a) text += line("point of A", vector_text(*answer.point_a));
  if (answer.point_b) text += line("point of B, in A's frame", vector_text(*answer.point_b));
  if (query != Query::manifold) return text;
  text += line("contacts", std::to_string(answer.contacts.size()));
  for (const ContactManifold::Contact& contact : answer.contacts) {
    text += line("   signed distance", shortest_number(contact.signed_distance));
    text += line("      point of A", vector_text(contact.point_a));
    text += line("      point of B, in A's frame", vector_text(contact.point_b));
  }
  return text;
}

}  // namespace

std::string report_text(const PairRun& run) {
  const Answer& answer = *run.one;
  const Query query = run.options.query.query;
  std::string text;
  if (run.options.dump_vertices) text += body_text(run.a, "A", true) + body_text(run.b, "B", true) + "\n";
  text += headline(run) + "\n";
  text += answer.is_undecided() ? line("because", why_undecided(run.options.query, answer))
                                : line("proven by", in_words(answer.verdict.by));
  text += value_text(query, answer) + witness_text(query, answer);
  text += line("support calls", std::to_string(answer.n_support_calls));
  if (run.options.layout.with_certificate) text += certificate_text(query, answer);
  return text;
}

}  // namespace vex
