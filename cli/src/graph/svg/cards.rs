//! Columns of cards: which rows a node's card has, and how high and wide they are.

use crate::graph::{Context, Cycler, Field, Graph, Node};

/// Height of a row, in pixels like all lengths here.
pub(super) const ROW: i32 = 18;
/// Height of a card's title.
pub(super) const TITLE: i32 = 27;
/// Height of the line that names the hardware traits.
pub(super) const INTERFACES: i32 = 16;
/// Height of a column's title.
pub(super) const COLUMN_TITLE: i32 = 54;
/// Between cards, and between a card and its column's border.
pub(super) const MARGIN: i32 = 14;
/// Between a card's border and its text.
pub(super) const PADDING: i32 = 12;
/// Where columns begin below the legend.
pub(super) const TOP: i32 = 66;

/// A cycler.
pub(super) struct Column<'g> {
    pub(super) cycler: &'g Cycler,
    /// In run order.
    pub(super) cards: Vec<Card<'g>>,
    /// Of the cards.
    pub(super) width: i32,
    pub(super) bottom: i32,
}

/// A node.
pub(super) struct Card<'g> {
    pub(super) node: &'g Node,
    pub(super) top: i32,
    pub(super) height: i32,
    pub(super) interfaces: String,
    pub(super) rows: Vec<Row<'g>>,
}

/// A field that values come through.
pub(super) struct Row<'g> {
    pub(super) field: &'g Field,
    pub(super) role: Role,
    pub(super) text: String,
    /// Vertical middle.
    pub(super) y: i32,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// Reads from a column on the left.
    FromLeft,
    /// Reads from its own column or one on the right.
    FromRight,
    /// Main output, or a state that others read.
    Writes,
    /// Main output that no node reads.
    Unread,
    /// Additional output or procedure: only for clients.
    ForClients,
}

pub(super) fn arrange(graph: &Graph, position: usize) -> Column<'_> {
    let cycler = &graph.cyclers[position];
    let mut top = TOP + COLUMN_TITLE;
    let mut cards = Vec::new();
    for node in cycler.in_run_order() {
        let card = arrange_card(graph, position, node, top);
        top += card.height + MARGIN;
        cards.push(card);
    }
    let title = text_width(&cycler.name).max(text_width(&subtitle(cycler)));
    let width = cards
        .iter()
        .map(Card::natural_width)
        .max()
        .unwrap_or(0)
        .max(title)
        .max(200);
    Column {
        cycler,
        cards,
        width,
        bottom: top,
    }
}

/// Kind and instances of a cycler.
pub(super) fn subtitle(cycler: &Cycler) -> String {
    match cycler.instances.as_slice() {
        [instance] if *instance == cycler.name => cycler.kind_in_words().to_owned(),
        instances => format!("{}: {}", cycler.kind_in_words(), instances.join(", ")),
    }
}

/// Of text in the picture's 12 pixel monospaced font.
pub(super) fn text_width(text: &str) -> i32 {
    let characters = i32::try_from(text.chars().count()).unwrap_or(i32::MAX / 32);
    (characters * 29 + 3) / 4
}

impl Card<'_> {
    /// Below the title and the hardware traits.
    fn natural_width(&self) -> i32 {
        let badges = 56 + if self.node.setup { 48 } else { 0 };
        let title = text_width(&self.node.path) + badges;
        let rows = self
            .rows
            .iter()
            .map(|row| text_width(&row.text) + 2 * PADDING + 30)
            .max();
        title
            .max(text_width(&self.interfaces) + 2 * PADDING)
            .max(rows.unwrap_or(0))
    }
}

fn arrange_card<'g>(graph: &'g Graph, position: usize, node: &'g Node, top: i32) -> Card<'g> {
    let interfaces = (node.interfaces.iter())
        .map(|path| path.rsplit("::").next().unwrap_or(path))
        .collect::<Vec<_>>()
        .join(", ");
    let mut rows: Vec<Row<'g>> = node
        .fields
        .iter()
        .filter_map(|field| arrange_row(graph, position, node, field))
        .collect();
    rows.sort_by_key(|row| match row.role {
        Role::FromLeft | Role::FromRight => 0,
        Role::Writes | Role::Unread => 1,
        Role::ForClients => 2,
    });
    let mut y = top + TITLE + if interfaces.is_empty() { 0 } else { INTERFACES } + 4;
    for row in &mut rows {
        row.y = y + ROW / 2;
        y += ROW;
    }
    Card {
        node,
        top,
        height: y + 6 - top,
        interfaces,
        rows,
    }
}

/// None: the field has no part in the flow of values.
fn arrange_row<'g>(
    graph: &'g Graph,
    position: usize,
    node: &'g Node,
    field: &'g Field,
) -> Option<Row<'g>> {
    let cycler = &graph.cyclers[position].name;
    let role = match field.kind {
        "MainOutput" if is_source(graph, cycler, node, &field.name) => Role::Writes,
        "MainOutput" => Role::Unread,
        "AdditionalOutput" | "Procedure" => Role::ForClients,
        _ if field.context != Context::Cycle => return None,
        "CyclerState" if is_source(graph, cycler, node, field.path.as_deref().unwrap_or("")) => {
            Role::Writes
        }
        _ => {
            let edge = graph.edges.iter().find(|edge| {
                let to = &edge.to;
                to.cycler == *cycler && to.node == node.path && to.field == field.name
            })?;
            let from = graph
                .cyclers
                .iter()
                .position(|from| from.name == edge.from.cycler)?;
            if from < position {
                Role::FromLeft
            } else {
                Role::FromRight
            }
        }
    };
    let path = field.path.as_deref().unwrap_or(&field.name);
    let text = match &field.instance {
        Some(instance) => format!("{instance}.{path}"),
        None => path.to_owned(),
    };
    Some(Row {
        field,
        role,
        text,
        y: 0,
    })
}

/// Whether a node reads this output or state of the node.
fn is_source(graph: &Graph, cycler: &str, node: &Node, output: &str) -> bool {
    graph.edges.iter().any(|edge| {
        let from = &edge.from;
        from.cycler == cycler && from.node == node.path && from.output == output
    })
}
