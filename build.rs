//! The SONAME, which cargo does not set by itself. While the version is 0.x, a change of the minor number may change the
//! ABI, so it is part of the name.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let part = |name: &str| std::env::var(format!("CARGO_PKG_VERSION_{name}")).unwrap_or_default();
    if std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|os| os == "linux") {
        let (major, minor) = (part("MAJOR"), part("MINOR"));
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libcstk.so.{major}.{minor}");
    }
}
