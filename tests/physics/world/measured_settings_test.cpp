// Proves that settings chosen by tolerance or budget hold what the table promises: no setting that
// is refused, none that is cheaper and as good, and a plain status where there is none.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "world/measured_table.h"

namespace plumb::inline PLUMB_ABI {
namespace {

constexpr SceneKind kKinds[] = {SceneKind::Any,     SceneKind::Free,    SceneKind::Bouncing,
                                SceneKind::Sliding, SceneKind::Jointed, SceneKind::Stacked};

TEST(MeasuredSettings, ChoiceKeepsToleranceAndIsTheCheapestThatDoes) {
  for (const SceneKind kind : kKinds) {
    for (const double tolerance : {0.5, 1e-1, 1e-2, 1e-3, 1e-4}) {
      const SettingsChoice choice = WorldSettings::from_tolerance(tolerance, kind);
      EXPECT_TRUE(check(choice.settings).ok());
      EXPECT_GT(choice.dt, 0);
      if (!choice.status.ok()) {
        EXPECT_EQ(choice.status.code, StatusCode::Unreachable);
        EXPECT_GT(choice.error, tolerance);
        continue;
      }
      EXPECT_LE(choice.error, tolerance) << name_of(kind);
      if (kind == SceneKind::Any) continue;
      for (const detail::MeasuredSetting& row : detail::kMeasured) {
        if (row.precision != std::string(kPrecisionName) || row.kind != kind) continue;
        EXPECT_FALSE(row.error <= tolerance && row.cost < choice.cost)
            << name_of(kind) << ' ' << tolerance << ": " << row.rate << ' ' << row.substeps;
      }
    }
  }
}

TEST(MeasuredSettings, BudgetIsKeptAndMoreBuysNoWorse) {
  for (const SceneKind kind : kKinds) {
    double error = 1e300;
    for (const double budget : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1.0}) {
      const SettingsChoice choice = WorldSettings::from_budget(budget, kind);
      if (!choice.status.ok()) {
        EXPECT_EQ(choice.status.code, StatusCode::Unreachable);
        EXPECT_GT(choice.cost, budget);
        continue;
      }
      EXPECT_LE(choice.cost, budget);
      EXPECT_LE(choice.error, error) << name_of(kind) << ' ' << budget;
      error = choice.error;
    }
    EXPECT_LT(error, 1e300) << name_of(kind);
  }
}

TEST(MeasuredSettings, AStepThatIsGivenIsNotExceeded) {
  for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    const SettingsChoice choice = WorldSettings::from_tolerance(0.5, SceneKind::Free, dt);
    EXPECT_TRUE(choice.status.ok());
    EXPECT_LE(choice.dt, dt * (1 + 1e-9));
  }
  EXPECT_EQ(WorldSettings::from_tolerance(0.5, SceneKind::Free, 1e-6).status.code,
            StatusCode::Unreachable);
}

TEST(MeasuredSettings, BadNumbersAreRefused) {
  const double nan = std::nan("");
  for (const double bad : {0.0, -1.0, nan, HUGE_VAL}) {
    EXPECT_EQ(WorldSettings::from_tolerance(bad).status.code, StatusCode::OutOfRange);
    EXPECT_EQ(WorldSettings::from_budget(bad).status.code, StatusCode::OutOfRange);
  }
  EXPECT_EQ(WorldSettings::from_tolerance(0.1, SceneKind::Any, -1).status.code,
            StatusCode::OutOfRange);
  EXPECT_EQ(WorldSettings::from_tolerance(0.1, SceneKind::Any, nan).status.code,
            StatusCode::OutOfRange);
  EXPECT_EQ(WorldSettings::from_tolerance(0.1, static_cast<SceneKind>(9)).status.code,
            StatusCode::OutOfRange);
  EXPECT_STRNE(measured_on(), "");
}

const detail::MeasuredSetting* row_of(SceneKind kind, const SettingsChoice& choice) {
  for (const detail::MeasuredSetting& row : detail::kMeasured)
    if (row.precision == std::string(kPrecisionName) && row.kind == kind &&
        row.substeps == choice.settings.substeps && std::abs(choice.dt * row.rate - 1) < 1e-9 &&
        row.joint_order == (kind == SceneKind::Jointed ? choice.settings.joint_order : 2))
      return &row;
  return nullptr;
}

// The error that is promised is that of the setting that is given, the order of joints included: of
// its row, or of the worst of the rows where the kind is open.
TEST(MeasuredSettings, ChoiceIsTheSettingThatWasMeasured) {
  for (const SceneKind kind : kKinds)
    for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
      const SettingsChoice choice = WorldSettings::from_tolerance(tolerance, kind);
      double error = 0, cost = 0;
      for (const SceneKind part : kKinds) {
        if (part == SceneKind::Any || (kind != SceneKind::Any && part != kind)) continue;
        const detail::MeasuredSetting* row = row_of(part, choice);
        ASSERT_NE(row, nullptr) << name_of(kind) << ' ' << tolerance;
        error = std::max(error, row->error);
        cost = std::max(cost, row->cost);
      }
      EXPECT_EQ(choice.error, error) << name_of(kind) << ' ' << tolerance;
      EXPECT_EQ(choice.cost, cost) << name_of(kind) << ' ' << tolerance;
      if (kind != SceneKind::Any && kind != SceneKind::Jointed) {
        EXPECT_EQ(choice.settings.joint_order, WorldSettings{}.joint_order) << name_of(kind);
      }
    }
}

// Where much is asked of joints the fourth order is the cheaper way to it; in float round-off comes
// before it pays.
TEST(MeasuredSettings, TightJointsAreOfFourthOrderInDouble) {
  const SettingsChoice loose = WorldSettings::from_tolerance(1e-2, SceneKind::Jointed);
  EXPECT_EQ(loose.settings.joint_order, 2);
  if (std::string(kPrecisionName) == "f64") {
    const SettingsChoice tight = WorldSettings::from_tolerance(1e-6, SceneKind::Jointed);
    EXPECT_TRUE(tight.status.ok());
    EXPECT_EQ(tight.settings.joint_order, 4);
  }
}

// The table is whole: every number type and kind, each at the same steps and substeps.
TEST(MeasuredSettings, TableHasEveryKindInEveryNumberType) {
  for (const char* precision : {"f32", "f32d", "f64"}) {
    for (const SceneKind kind : kKinds) {
      if (kind == SceneKind::Any) continue;
      int rows = 0;
      for (const detail::MeasuredSetting& row : detail::kMeasured)
        rows += row.precision == std::string(precision) && row.kind == kind ? 1 : 0;
      const int orders = kind == SceneKind::Jointed ? 2 : 1;
      EXPECT_EQ(rows, 25 * orders) << precision << ' ' << name_of(kind);
    }
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
