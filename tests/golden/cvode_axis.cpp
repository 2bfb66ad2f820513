#include "tests/golden/cvode_axis.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace feedtwin::golden {
namespace {

constexpr State scale = {1e-4, 1e-2, 1e-7, 1e-6, 1e-2, 1e-2, 1e-2, 1e-2};  ///< below it, tolerances are absolute

void check(int flag, const char* what) {
  if (flag < 0) throw std::runtime_error(std::string(what) + " failed with " + std::to_string(flag));
}

}  // namespace

struct CvodeAxis::Solver {
  FeedDrive drive;
  Mode mode = Mode::stuck;
  double force_N = 0.0;
  State y{};
  int sticks = 0, reversals = 0;
  SUNContext context = nullptr;
  N_Vector vector = nullptr, tolerance = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver linear = nullptr;
  void* cvode = nullptr;

  static int rhs(sunrealtype, N_Vector y, N_Vector dy, void* self) {
    const auto& s = *static_cast<const Solver*>(self);
    derivative(s.drive, s.mode, s.force_N, N_VGetArrayPointer(y), N_VGetArrayPointer(dy));
    return 0;
  }
  static int root(sunrealtype, N_Vector y, sunrealtype* g, void*) {
    g[0] = N_VGetArrayPointer(y)[velocity];
    return 0;
  }

  Solver(const FeedDrive& d, double relative) : drive(d) {
    check(SUNContext_Create(nullptr, &context), "SUNContext_Create");
    vector = N_VMake_Serial(unknowns, y.data(), context);
    tolerance = N_VNew_Serial(unknowns, context);
    for (int i = 0; i < unknowns; ++i) N_VGetArrayPointer(tolerance)[i] = relative * scale[static_cast<std::size_t>(i)];
    cvode = CVodeCreate(CV_BDF, context);
    check(CVodeInit(cvode, rhs, 0.0, vector), "CVodeInit");
    check(CVodeSVtolerances(cvode, relative, tolerance), "CVodeSVtolerances");
    check(CVodeSetUserData(cvode, this), "CVodeSetUserData");
    check(CVodeRootInit(cvode, 1, root), "CVodeRootInit");
    check(CVodeSetMaxNumSteps(cvode, 100000), "CVodeSetMaxNumSteps");
    check(CVodeSetNoInactiveRootWarn(cvode), "CVodeSetNoInactiveRootWarn");
    matrix = SUNDenseMatrix(unknowns, unknowns, context);
    linear = SUNLinSol_Dense(vector, matrix, context);
    check(CVodeSetLinearSolver(cvode, linear, matrix), "CVodeSetLinearSolver");
  }
  ~Solver() {
    CVodeFree(&cvode);
    SUNLinSolFree(linear);
    SUNMatDestroy(matrix);
    N_VDestroy(vector);
    N_VDestroy(tolerance);
    SUNContext_Free(&context);
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  /// From rest or a reversal at t; returns the time that it stopped at.
  double advance(double t, double end) {
    if (y[velocity] == 0.0) {
      mode = mode_from_rest(drive, y, force_N);
    } else {
      mode = y[velocity] > 0.0 ? Mode::forward : Mode::backward;
    }
    if (mode == Mode::stuck) {
      y[electrical_loss] += drive.ke0_W * (end - t);
      ++sticks;
      return end;
    }
    check(CVodeReInit(cvode, t, vector), "CVodeReInit");
    check(CVodeSetStopTime(cvode, end), "CVodeSetStopTime");
    const int flag = CVode(cvode, end, vector, &t, CV_NORMAL);
    check(flag, "CVode");
    if (flag != CV_ROOT_RETURN) return end;
    y[velocity] = 0.0;
    ++reversals;
    return t;
  }
};

CvodeAxis::CvodeAxis(const FeedDrive& drive, double relative_tolerance)
    : solver_(std::make_unique<Solver>(drive, relative_tolerance)) {}
CvodeAxis::~CvodeAxis() = default;
CvodeAxis::CvodeAxis(CvodeAxis&&) noexcept = default;

void CvodeAxis::tick(double force_N, double tick_s) {
  solver_->force_N = force_N;
  for (double t = 0.0; t < tick_s * (1.0 - 1e-12);) t = solver_->advance(t, tick_s);
}

const State& CvodeAxis::state() const {
  return solver_->y;
}
void CvodeAxis::set_state(const State& y) {
  solver_->y = y;
}
int CvodeAxis::sticks() const {
  return solver_->sticks;
}
int CvodeAxis::reversals() const {
  return solver_->reversals;
}

}  // namespace feedtwin::golden
