//! include/cstk.h is what cbindgen writes today. `scripts/header.sh` rewrites it.

use std::path::Path;

#[test]
fn header_is_current() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(root.join("cbindgen.toml")).unwrap();
    let mut generated = Vec::new();
    // The C layer alone, in the order in which src/capi/mod.rs names its modules.
    let modules = std::fs::read_to_string(root.join("src/capi/mod.rs")).unwrap();
    let mut builder = cbindgen::Builder::new().with_config(config);
    for module in modules
        .lines()
        .filter_map(|line| line.strip_prefix("pub mod "))
    {
        let module = module.trim_end_matches(';');
        builder = builder.with_src(root.join(format!("src/capi/{module}.rs")));
    }
    builder.generate().unwrap().write(&mut generated);
    let generated = String::from_utf8(generated).unwrap();
    let path = root.join("include/cstk.h");
    if std::env::var_os("CSTK_UPDATE_HEADER").is_some() {
        std::fs::write(&path, &generated).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    if let Some((line, (old, new))) = committed
        .lines()
        .zip(generated.lines())
        .enumerate()
        .find(|(_, (old, new))| old != new)
    {
        panic!(
            "include/cstk.h:{} is\n  {old}\nbut should be\n  {new}\nrun scripts/header.sh",
            line + 1
        );
    }
    assert_eq!(
        committed.lines().count(),
        generated.lines().count(),
        "run scripts/header.sh"
    );
}
