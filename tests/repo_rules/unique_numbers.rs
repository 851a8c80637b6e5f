//! The numbers that tell options structures and handles apart: each is used once.

use std::collections::BTreeMap;

use super::{root, sources};

#[test]
fn cookies_and_kinds_are_unique() {
    for constant in ["const COOKIE: u32 = ", "const KIND: u32 = "] {
        let mut users: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for path in sources(&root().join("src/capi")) {
            let text = std::fs::read_to_string(&path).unwrap();
            for line in text.lines() {
                if let Some((_, number)) = line.split_once(constant) {
                    let user = path.display().to_string();
                    users.entry(number.to_string()).or_default().push(user);
                }
            }
        }
        assert!(users.len() > 8, "{constant}: {users:?}");
        let shared = users.values().find(|users| users.len() > 1);
        assert!(shared.is_none(), "{constant} is the same in {shared:?}");
    }
}
