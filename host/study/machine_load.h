// What other programs take of the machine while we measure.
#pragma once

namespace pellucid {

/// From its making on. Knows nothing where the system does not tell (then share() is 0).
/// Share that other processes take in half a second during which this one sleeps.
double foreign_load_now();

class MachineLoad {
 public:
  MachineLoad();
  /// Of all processors' time, the share that was neither idle nor ours.
  double share() const;

 private:
  struct Ticks {
    double busy = 0, all = 0, ours = 0;  ///< seconds
  };
  static Ticks now();
  Ticks start_;
};

}  // namespace pellucid
