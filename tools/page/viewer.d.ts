/** What Rerun's viewer brings to its page. */
declare const wasm_bindgen: {
  (how: { module_or_path: Promise<Response> }): Promise<void>;
  WebHandle: new (how: object) => {
    start(canvas: HTMLElement): Promise<void>;
    open_channel(id: string, name: string): void;
    send_rrd_to_channel(id: string, bytes: Uint8Array): void;
    close_channel(id: string): void;
  };
};
