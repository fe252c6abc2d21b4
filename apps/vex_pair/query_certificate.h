// The certificates of queries that tell more than whether bodies overlap: found, checked, and written.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <variant>

#include "engine/query/contact_certificate.h"
#include "engine/query/manifold_certificate.h"
#include "engine/query/separation_certificate.h"

namespace vex {

/// Of a ray against both bodies.
struct RayCertificate {
  ContactCertificate of_a, of_b;
};

/// Nothing of an overlap query, whose rows have an OverlapCertificate.
using QueryCertificate =
    std::variant<std::monostate, SeparationCertificate, ManifoldCertificate, ContactCertificate, RayCertificate>;

/// As a row's `certificate` has it; docs/queries.md says what each member proves.
nlohmann::ordered_json certificate_json(const QueryCertificate& certificate);

/// How much of what proves it: for eyes.
std::string certificate_summary(const QueryCertificate& certificate);

}  // namespace vex
