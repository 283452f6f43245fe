//! The numbers that the walk is tested with, in its own tests and on the simulator's physics: the robot's.

use std::sync::LazyLock;

use framework::testing::ParameterFile;
use walking::Parameters;

static PARAMETERS: LazyLock<Parameters> = LazyLock::new(|| {
    ParameterFile::new(include_str!("../../../parameters/default.toml")).get("walking_engine")
});

/// As the parameter files have them.
pub(crate) fn parameters() -> Parameters {
    *PARAMETERS
}
