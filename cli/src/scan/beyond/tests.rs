//! The list of the framework's names against the framework.

use std::collections::BTreeSet;

use syn::{Item, UseTree, Visibility};

use super::OF_FRAMEWORK;

fn names(tree: &UseTree, found: &mut BTreeSet<String>) {
    match tree {
        UseTree::Path(path) => names(&path.tree, found),
        UseTree::Group(group) => group.items.iter().for_each(|tree| names(tree, found)),
        UseTree::Name(name) => _ = found.insert(name.ident.to_string()),
        UseTree::Rename(name) => _ = found.insert(name.rename.to_string()),
        UseTree::Glob(_) => panic!("name them"),
    }
}

#[test]
fn what_the_framework_offers_is_listed() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../framework/src/lib.rs");
    let text = std::fs::read_to_string(root).expect("the framework lies beside");
    let syntax = syn::parse_file(&text).expect("it is Rust");
    let mut found = BTreeSet::new();
    for item in &syntax.items {
        match item {
            Item::Use(item) if matches!(item.vis, Visibility::Public(_)) => {
                names(&item.tree, &mut found);
            }
            Item::Mod(item) if matches!(item.vis, Visibility::Public(_)) => {
                found.insert(item.ident.to_string());
            }
            _ => {}
        }
    }
    let listed: Vec<&str> = OF_FRAMEWORK.split_whitespace().collect();
    assert_eq!(listed, found.iter().collect::<Vec<_>>());
}
