//! Lets the linker of macOS leave Python's symbols open: the interpreter that loads the library has them.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    // For the target, not for the machine that compiles this.
    if std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|system| system == "macos") {
        println!("cargo:rustc-cdylib-link-arg=-undefined");
        println!("cargo:rustc-cdylib-link-arg=dynamic_lookup");
    }
}
