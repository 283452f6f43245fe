// The bundle is checked in: its names must not change with its contents, and nothing may be fetched from elsewhere.
import { defineConfig } from "vite";

export default defineConfig({
  // Relative, so that the page also works below a path of a proxy.
  base: "./",
  publicDir: false,
  build: {
    outDir: "../dist",
    emptyOutDir: true,
    // Browsers of phones and robots' laptops of the last years.
    target: "es2022",
    modulePreload: false,
    // The content security policy of the page forbids `data:` scripts and styles.
    assetsInlineLimit: 0,
    rollupOptions: {
      output: {
        entryFileNames: "page.js",
        chunkFileNames: "[name].js",
        assetFileNames: "page.[ext]",
      },
    },
  },
  // `npm run dev` shows changes at once, with the robot of this machine.
  server: {
    proxy: { "/socket": { target: "ws://127.0.0.1:4857", ws: true } },
  },
});
