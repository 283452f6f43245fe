// Begins: connection → store → panels, in this one direction.
import { Arrangement } from "./store/layout";
import { Robots } from "./store/robots";
import "./style/base.css";
import "./style/frame.css";
import "./style/panels.css";
import "./style/robotics.css";
import "./style/time.css";
import { header } from "./view/header";
import { Sidebar } from "./view/sidebar";
import { Workspace } from "./view/workspace";

const address = new URL("socket", location.href);
address.protocol = address.protocol === "https:" ? "wss:" : "ws:";
address.search = "";
address.hash = "";

// Robots name each other with a port always, browsers leave out that of the scheme.
const own = location.port === "" && location.protocol === "http:" ? `${location.hostname}:80` : location.host;
const robots = new Robots(own, address.href);
const arrangement = new Arrangement();
const sidebar = new Sidebar(robots.own, arrangement);
const workspace = new Workspace(robots, arrangement);
document.body.replaceChildren(header(robots, arrangement), sidebar.element, workspace.element);
