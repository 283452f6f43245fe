//! The graph as one page that needs no other file: the picture with zoom, search and highlighting.

use super::{Graph, svg};

/// A self-contained HTML file.
pub fn render(graph: &Graph) -> String {
    let title = escape(&format!("Robot {}", graph.robot));
    embedded("graph.html")
        .replace("{{title}}", &title)
        .replace(
            "{{favicon}}",
            &percent_encode(embedded("favicon.svg").trim_end()),
        )
        .replace("{{script}}", embedded("graph.js"))
        .replace("{{graph}}", &svg::render(graph))
}

fn embedded(path: &str) -> &'static str {
    let file = web::file(path).expect("the page's files are embedded");
    std::str::from_utf8(file.bytes).expect("the page's files are text")
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

/// For a `data:` address between double quotes.
fn percent_encode(text: &str) -> String {
    let mut encoded = String::new();
    for character in text.chars() {
        match character {
            '"' => encoded.push('\''),
            '#' => encoded.push_str("%23"),
            '%' => encoded.push_str("%25"),
            '<' => encoded.push_str("%3C"),
            '>' => encoded.push_str("%3E"),
            other => encoded.push(other),
        }
    }
    encoded
}
