#include "engine/query/certificate.h"

namespace vex {

CertificateCheck check_certificate(const ConvexBody&, const ConvexBody&, const Transformd&, Outcome,
                                   const OverlapCertificate&) {
  return {false, "not built"};
}

}  // namespace vex
