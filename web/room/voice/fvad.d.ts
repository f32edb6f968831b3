declare module "@echogarden/fvad-wasm" {
  interface Fvad {
    readonly HEAP16: Int16Array;
    _malloc(bytes: number): number;
    _fvad_new(): number;
    _fvad_set_mode(state: number, mode: number): number;
    _fvad_set_sample_rate(state: number, hertz: number): number;
    /** 1 for a voice, 0 for none, -1 for a frame of another length than 10, 20 or 30 ms. */
    _fvad_process(state: number, frame: number, samples: number): number;
  }
  export default function make(options: { locateFile(name: string): string }): Promise<Fvad>;
}
