//! Generated models and scenes for tests and benchmarks.
