//! Options of the commands that trace paths of light.

use super::values;
use clap::Args;
use gonio_trace::{TraceGoal, TraceSettings};
use std::time::Duration;

/// When a trace ends, and how paths are followed. `--samples` is one of the options of the scene, and conflicts with `--time` and
/// `--error`.
#[derive(Args, Debug, Clone)]
pub struct TraceOptions {
    /// Trace for this many seconds.
    #[arg(long, help_heading = "Trace options", value_name = "SECONDS", value_parser = values::seconds,
          conflicts_with = "error", allow_negative_numbers = true)]
    pub time: Option<f64>,
    /// Trace until the error of a pixel is this percentage of the mean brightness, with 95 % confidence.
    #[arg(long, help_heading = "Trace options", value_name = "PERCENT", value_parser = values::percent,
          allow_negative_numbers = true)]
    pub error: Option<f64>,
    /// Surfaces that a path meets at most; 2 means direct light only.
    #[arg(long, help_heading = "Trace options", value_name = "N", default_value = "64",
          value_parser = values::depth, allow_negative_numbers = true)]
    pub max_depth: u32,
    /// Seed of the random numbers: another one gives other noise.
    #[arg(long, help_heading = "Trace options", value_name = "N", default_value = "0", value_parser = values::seed,
          allow_negative_numbers = true)]
    pub seed: u64,
    /// Threads; all cores by default.
    #[arg(long, help_heading = "Trace options", value_name = "N", value_parser = values::threads,
          allow_negative_numbers = true)]
    pub threads: Option<u16>,
    /// Moment of the scene in seconds, for lights and objects that move.
    #[arg(long, help_heading = "Light options", value_name = "SECONDS", value_parser = values::number,
          allow_negative_numbers = true, default_value = "0")]
    pub moment: f64,
}

impl TraceOptions {
    /// The goal; `samples` is the value of `--samples`, `default` the number of paths if no option has a goal.
    pub fn goal(&self, samples: Option<u32>, default: u32) -> TraceGoal {
        match (self.time, self.error) {
            (Some(seconds), _) => TraceGoal::Time(Duration::from_secs_f64(seconds)),
            (_, Some(percent)) => TraceGoal::Error(percent / 100.0),
            (None, None) => TraceGoal::Paths(samples.unwrap_or(default)),
        }
    }

    /// Settings with these values; all others are the defaults.
    pub fn settings(&self) -> TraceSettings {
        TraceSettings { most_depth: self.max_depth, seed: self.seed, ..TraceSettings::default() }
    }
}
