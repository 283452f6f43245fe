//! The text of a card.

use super::cards::{Card, Column, INTERFACES, PADDING, Role, Row, TITLE};
use super::text::escape;
use crate::graph::lines::line;

pub(super) fn draw_card(text: &mut String, column: &Column<'_>, card: &Card<'_>, left: i32) {
    let Card {
        node, top, height, ..
    } = card;
    let width = column.width;
    let class = if node.setup { "node setup" } else { "node" };
    let path = escape(&node.path);
    let order = node.order;
    let key = escape(&format!("{}/{}", column.cycler.name, node.path));
    line(
        text,
        format_args!("<g class=\"{class}\" data-node=\"{key}\">"),
    );
    line(
        text,
        format_args!("<title>{path} ({})</title>", escape(&node.file)),
    );
    line(
        text,
        format_args!(
            "<rect class=\"card\" x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" rx=\"6\"/>\
         <path class=\"title\" d=\"M{left} {}v{}a6 6 0 0 1 6 -6h{}a6 6 0 0 1 6 6v{}z\"/>",
            top + TITLE,
            6 - TITLE,
            width - 12,
            TITLE - 6
        ),
    );
    line(
        text,
        format_args!(
            "<text class=\"order\" x=\"{}\" y=\"{}\">{order}</text><text class=\"name\" x=\"{}\" y=\"{}\">{path}</text>",
            left + 22,
            top + 18,
            left + 32,
            top + 18
        ),
    );
    if node.setup {
        line(
            text,
            format_args!(
                "<text class=\"mark\" x=\"{}\" y=\"{}\">setup</text>",
                left + width - PADDING,
                top + 18
            ),
        );
    }
    if !card.interfaces.is_empty() {
        line(
            text,
            format_args!(
                "<text class=\"interface\" x=\"{}\" y=\"{}\">{}</text>",
                left + PADDING,
                top + TITLE + INTERFACES - 2,
                escape(&card.interfaces)
            ),
        );
    }
    for row in &card.rows {
        draw_row(text, row, left, width);
    }
    line(text, format_args!("</g>"));
}

fn draw_row(text: &mut String, row: &Row<'_>, left: i32, width: i32) {
    let right = left + width;
    let (class, x) = match row.role {
        Role::FromLeft => ("reads left", left + PADDING),
        Role::FromRight => ("reads", right - PADDING),
        Role::Writes | Role::Unread => ("writes", right - PADDING),
        Role::ForClients => ("clients", right - PADDING),
    };
    let data = row.field.data.as_deref().unwrap_or_default();
    // Without its line: a checked-in picture would change with every comment above the field.
    let about = format!("{} {}: {data}", row.field.kind, row.field.name);
    line(
        text,
        format_args!(
            "<text class=\"{class}\" x=\"{x}\" y=\"{}\">{}<title>{}</title></text>",
            row.y + 4,
            escape(&row.text),
            escape(&about)
        ),
    );
    match row.role {
        Role::Unread => line(
            text,
            format_args!(
                "<circle class=\"unread\" cx=\"{right}\" cy=\"{}\" r=\"3.5\"/>",
                row.y
            ),
        ),
        Role::ForClients => line(
            text,
            format_args!(
                "<circle class=\"client\" cx=\"{right}\" cy=\"{}\" r=\"3.5\"/>",
                row.y
            ),
        ),
        Role::FromLeft | Role::FromRight | Role::Writes => {}
    }
}
