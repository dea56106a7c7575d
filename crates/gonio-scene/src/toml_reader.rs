//! TOML with errors that say where and what was meant.
