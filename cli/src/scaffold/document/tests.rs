//! Lists in every layout that people write.

use super::{list, parse, push, remove};

fn edited(text: &str, edit: impl Fn(&mut toml_edit::Array)) -> String {
    let mut document = parse("hulk.toml".into(), text).expect("it is TOML");
    edit(list(document.as_table_mut(), "nodes").expect("it is a list"));
    document.to_string()
}

#[test]
fn an_element_is_added_in_the_layout_of_the_list() {
    for (before, after) in [
        ("nodes = []\n", "nodes = [\"c\"]\n"),
        ("nodes = [\"a\"]\n", "nodes = [\"a\", \"c\"]\n"),
        (
            "nodes = [ \"a\", \"b\" ] # two\n",
            "nodes = [ \"a\", \"b\", \"c\" ] # two\n",
        ),
        (
            "nodes = [\n    \"a\",\n]\n",
            "nodes = [\n    \"a\",\n    \"c\",\n]\n",
        ),
        (
            "nodes = [\n  \"a\",\n  \"b\"\n]\n",
            "nodes = [\n  \"a\",\n  \"b\",\n  \"c\"\n]\n",
        ),
        (
            "nodes = [\n    \"a\", # first\n    # second\n    \"b\", # last\n]\n",
            "nodes = [\n    \"a\", # first\n    # second\n    \"b\", # last\n    \"c\",\n]\n",
        ),
        (
            "nodes = [\n    \"a\", # first\n    # \"old\",\n]\n",
            "nodes = [\n    \"a\", # first\n    # \"old\",\n    \"c\",\n]\n",
        ),
        ("kind = \"x\"\n", "kind = \"x\"\nnodes = [\"c\"]\n"),
    ] {
        assert_eq!(edited(before, |list| push(list, "c")), after);
    }
}

#[test]
fn an_element_is_removed_with_its_own_comments_alone() {
    for (before, index, after) in [
        ("nodes = [\"a\", \"b\"]\n", 0, "nodes = [\"b\"]\n"),
        ("nodes = [\"a\", \"b\"]\n", 1, "nodes = [\"a\"]\n"),
        ("nodes = [\"a\"]\n", 0, "nodes = []\n"),
        ("nodes = [\n    \"a\",\n]\n", 0, "nodes = []\n"),
        (
            "nodes = [\n    \"a\",\n    \"b\",\n]\n",
            1,
            "nodes = [\n    \"a\",\n]\n",
        ),
        (
            "nodes = [\n    \"a\",\n    \"b\"\n]\n",
            1,
            "nodes = [\n    \"a\"\n]\n",
        ),
        (
            "nodes = [\n    \"a\", # first\n    # second\n    \"b\", # beside\n    \"c\",\n]\n",
            1,
            "nodes = [\n    \"a\", # first\n    \"c\",\n]\n",
        ),
        (
            "nodes = [\n    \"a\", # first\n    \"b\", # beside\n]\n",
            1,
            "nodes = [\n    \"a\", # first\n]\n",
        ),
    ] {
        assert_eq!(
            edited(before, |list| remove(list, index)),
            after,
            "{before}"
        );
    }
}
