//! OpenGL that is opened when it is first used.

use super::context;
use crate::{DeferredGl, Dialect, GlError};
use std::cell::Cell;
use std::rc::Rc;

#[test]
fn opengl_is_opened_once_and_when_it_is_used() {
    let opened = Rc::new(Cell::new(0));
    let count = Rc::clone(&opened);
    let gl = DeferredGl::new(Dialect::Core330, move || {
        count.set(count.get() + 1);
        Ok(context(false).gl().clone())
    });
    assert_eq!((gl.dialect(), opened.get()), (Dialect::Core330, 0));
    let version = gl.get().map(|gl| gl.version()).unwrap_or_else(|error| panic!("{error}"));
    assert!(version >= (3, 3), "{version:?}");
    assert_eq!(gl.get().map(|gl| gl.version()), Ok(version));
    assert_eq!(opened.get(), 1);
}

#[test]
fn an_error_of_opening_is_that_of_each_use() {
    let gl = DeferredGl::new(Dialect::Es300, || Err(GlError::new("no driver")));
    for _ in 0..2 {
        assert_eq!(gl.get().err(), Some(GlError::new("no driver")));
    }
}
