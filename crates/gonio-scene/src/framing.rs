//! A scene without camera or lights gets pleasant ones.
