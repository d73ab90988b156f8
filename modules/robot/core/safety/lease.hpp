#pragma once

#include <optional>

#include "common/archive.hpp"
#include "common/time.hpp"

namespace priamos::robot {

/// Who may drive, in ascending order of precedence.
enum class Driver { kNobody, kPlanner, kConsole, kTeleop };

/// One process that drives. `session` distinguishes two processes of the same kind.
struct LeaseHolder {
  Driver driver = Driver::kNobody;
  int session = 0;

  friend bool operator==(const LeaseHolder&, const LeaseHolder&) = default;
};

/// Times after which a silent holder loses the lease.
struct LeaseConfig {
  double keep_s = 3;  ///< a holder that is silent for this long loses the lease

  void Describe(Archive& a);
};

/// Exactly one driver at a time. A free lease is granted to whoever asks. A held one is refused, also to a
/// higher rank, unless that request is a take-over: nobody loses the wheel by accident. Taking over needs the
/// same or a higher rank. Every sign of life of the holder renews it.
class Lease {
 public:
  /// What somebody asks for; kTakeOver also takes a held lease away.
  enum class Wish { kAcquire, kTakeOver, kRelease };
  /// What became of a request; kRenewed: who asked had the lease already.
  enum class Answer { kGranted, kRenewed, kReleased, kRefused };

  explicit Lease(const LeaseConfig& config) : config_(config) {}

  Answer Request(const LeaseHolder& who, Wish wish, Time now);
  /// The holder gave a sign of life. Nothing for anybody else.
  void Renew(const LeaseHolder& who, Time now);
  /// Takes the lease from a holder that has been silent for too long.
  void Expire(Time now);

  bool IsHeldBy(const LeaseHolder& who) const { return holder_ == who && who.driver != Driver::kNobody; }
  const LeaseHolder& holder() const { return holder_; }

 private:
  LeaseConfig config_;
  LeaseHolder holder_;
  Time heard_{};
};

}  // namespace priamos::robot
